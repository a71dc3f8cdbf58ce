// The one exception family. Thrown deep, caught once in `main`; a programming error is an assert (check.h),
// not one of these.
#pragma once

#include <stdexcept>
#include <string>

namespace hybray {

// Base of all errors that a user can cause. `what()` is one clear message.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Wrong input: a config, a scene, a parameter. `where` is the place as the user knows it ("file.json:12:7",
// "/sweep/scene", a path); the message reads "where: what is wrong".
class InputError : public Error {
 public:
  InputError(const std::string& where, const std::string& message)
      : Error(where + ": " + message), where_(where) {}
  const std::string& where() const { return where_; }

 private:
  std::string where_;
};

// The work itself failed (a device error, a full disk): not the fault of the config.
class RuntimeError : public Error {
 public:
  using Error::Error;
};

}  // namespace hybray
