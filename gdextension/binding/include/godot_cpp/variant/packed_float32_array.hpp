#pragma once

#include <godot_cpp/subset/packed_array.hpp>

namespace godot {

class PackedFloat32Array
    : public subset::PackedArray<GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY, float,
                                 &subset::Interface::packed_float32_array_operator_index_const,
                                 &subset::Interface::packed_float32_array_operator_index,
                                 &subset::Interface::packed_float32_array_size,
                                 &subset::Interface::packed_float32_array_resize> {};

}  // namespace godot
