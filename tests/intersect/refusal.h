#pragma once
// What queries say of questions that they refuse.
#include <functional>
#include <string>

#include "schemes/errors.h"

namespace shaolin {

/// The message of the InputError that an act throws.
inline std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace shaolin
