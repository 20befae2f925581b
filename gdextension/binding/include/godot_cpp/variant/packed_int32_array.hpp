#pragma once

#include <godot_cpp/subset/packed_array.hpp>

namespace godot {

class PackedInt32Array
    : public subset::PackedArray<GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY, std::int32_t,
                                 &subset::Interface::packed_int32_array_operator_index_const,
                                 &subset::Interface::packed_int32_array_operator_index,
                                 &subset::Interface::packed_int32_array_size,
                                 &subset::Interface::packed_int32_array_resize> {};

}  // namespace godot
