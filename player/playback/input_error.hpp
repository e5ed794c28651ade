#pragma once
#include <string>

#include <tvg/types.hpp>

namespace tvg::player {

/// What befell an input, with its name in front.
inline Error input_error(const std::string& name, const std::string& what) {
  return {ErrorCode::kIo, name + ": " + what, {}, {}, ""};
}

}  // namespace tvg::player
