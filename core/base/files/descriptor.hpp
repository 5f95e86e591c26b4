#pragma once

#include <string_view>
#include <utility>

namespace mapproof {

/// A file descriptor, closed at the end of its life; negative: none.
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
  /// Closes it now. @return False if close() reports an error, as of an earlier write; errno says
  /// which.
  bool close();

 private:
  int number_;
};

/// Writes all of `bytes`, in as many calls as that takes. @return False if it could not; errno
/// holds the reason.
bool write_all(const Descriptor& file, std::string_view bytes);

}  // namespace mapproof
