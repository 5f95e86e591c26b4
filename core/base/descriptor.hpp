#pragma once

#include <string_view>

namespace mapproof {

/// A file descriptor that closes itself; negative: none.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  /// @return Whether all that was written has arrived; errno says why not.
  bool close();

 private:
  int number_;
};

/// Writes all of `bytes`, however many calls that takes. @return Whether it could; errno says why
/// not.
bool write_all(const Descriptor& file, std::string_view bytes);

}  // namespace mapproof
