#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/results/results_study.hpp"

namespace mapproof {

/// Rows of one quantity, mpe_m: setup "s", the group of a run its first letter.
class Rows {
 public:
  explicit Rows(std::string quantity = "mpe_m") : quantity_(std::move(quantity)) {}

  Rows& add(const std::string& method, const std::string& run, double value,
            std::vector<Level> levels = {}, const std::string& subject = "") {
    study_.results.rows.push_back({.at = condition("s", std::move(levels)),
                                   .method = method,
                                   .quantity = quantity_,
                                   .run = run,
                                   .group = run.substr(0, 1),
                                   .subject = subject,
                                   .value = value});
    return *this;
  }

  void declare(const Quantity& quantity) { study_.results.quantities.declare(quantity); }

  ResultsStudy study(bool are_repeats = true) {
    study_.name = "test";
    study_.title = "Test";
    study_.results.are_repeats = are_repeats;
    sort_results(study_.results);
    EXPECT_EQ(complete(study_), "");
    return study_;
  }

 private:
  std::string quantity_;
  ResultsStudy study_;
};

inline const Quantity& mpe() { return known_quantity("mpe_m"); }

}  // namespace mapproof
