#pragma once

#include <memory>

namespace mapproof {

/// An OpenGL 3.2 context without a screen. A program is linked with one of two implementations:
/// osmesa_context.cpp, or egl_context.cpp (EGL without a surface).
class GlContext {
 public:
  /// @throws std::runtime_error, in one line, if no context can be made.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// @return Whether that worked.
  bool make_current();
  bool is_current() const;

  using Function = void (*)();
  /// The OpenGL function of this name; null if there is none.
  static Function function(const char* name);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mapproof
