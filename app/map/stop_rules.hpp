#pragma once

#include "core/embed/embedder.hpp"

namespace mapproof {

/// How far SMACOF goes on a user's observations: near the minimum of the stress. Studies stop where
/// the experiment says.
inline SmacofOptions near_minimum() { return {.relative_fall = 1e-10, .max_iterations = 20'000}; }

/// An embedder's options for a user's observations. Weighted SMACOF still stops early.
inline EmbedderOptions options_for_users() {
  EmbedderOptions options;
  options.smacof = near_minimum();
  return options;
}

}  // namespace mapproof
