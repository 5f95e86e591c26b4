#pragma once

#include <string_view>
#include <utility>

namespace mapproof {

/// A file descriptor that closes itself; negative: none.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    close();
    number_ = std::exchange(other.number_, -1);
    return *this;
  }

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
