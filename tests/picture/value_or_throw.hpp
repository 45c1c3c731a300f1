/// Results whose failure fails the test.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace eyepoint::testing {

template <typename T>
T value_or_throw(tl::expected<T, std::string> made) {
    if (!made) throw std::runtime_error(made.error());
    return std::move(*made);
}

}  // namespace eyepoint::testing
