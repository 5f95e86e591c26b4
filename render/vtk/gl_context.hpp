#pragma once

#include <memory>

namespace mapproof {

/// A context of OpenGL 3.2 in memory, without a screen. A program is linked with one of its two
/// sources: osmesa_context.cpp, or egl_context.cpp (EGL without a surface).
class GlContext {
 public:
  /// @throws std::runtime_error, in one line, if there is none.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// @return Whether it is the current one now.
  bool make_current();
  bool is_current() const;

  using Function = void (*)();
  /// OpenGL's function of this name; null if there is none.
  static Function function(const char* name);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mapproof
