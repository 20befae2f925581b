#pragma once

namespace lobelight {

// The decimal number that a single-precision `value` was written as: the shortest one that rounds
// to it. 0.1f is 0.10000000149…; a recipe should mean the same however its 0.1 is passed, and
// 0.0001f must not fall short of a bound of 0.0001. What is not finite stays what it is.
double as_written(float value);

}  // namespace lobelight
