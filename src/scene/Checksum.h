// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <xxhash.h>

#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>

namespace bwfirt {

/// A checksum of 64 bits, XXH3, over all that is added: it finds damage, not forgery.
class Checksum {
  public:
    Checksum() : state_(XXH3_createState(), &XXH3_freeState) {
        if (state_ == nullptr)
            throw std::bad_alloc();
        XXH3_64bits_reset(state_.get());
    }

    void addBytes(const void* bytes, std::size_t size) {
        XXH3_64bits_update(state_.get(), bytes, size);
    }

    /// Adds the bytes of a value that holds nothing between its members.
    template <typename T>
    void add(const T& value) {
        static_assert(!std::is_pointer_v<T>);
        addBytes(&value, sizeof value);
    }

    std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// The checksum of these bytes alone.
inline std::uint64_t checksumOfBytes(const void* bytes, std::size_t size) {
    return XXH3_64bits(bytes, size);
}

}  // namespace bwfirt
