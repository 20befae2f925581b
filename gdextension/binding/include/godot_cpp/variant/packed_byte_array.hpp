#pragma once

#include <godot_cpp/subset/packed_array.hpp>

namespace godot {

class PackedByteArray
    : public subset::PackedArray<GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY, std::uint8_t,
                                 &subset::Interface::packed_byte_array_operator_index_const,
                                 &subset::Interface::packed_byte_array_operator_index,
                                 &subset::Interface::packed_byte_array_size,
                                 &subset::Interface::packed_byte_array_resize> {};

}  // namespace godot
