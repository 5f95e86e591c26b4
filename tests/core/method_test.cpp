#include "core/model/method.hpp"

#include <set>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

TEST(MethodNames, FindTheNearest) {
  EXPECT_EQ(nearest_method_name("isomp"), "isomap");
  EXPECT_EQ(nearest_method_name("smacof_knn"), "smacof-knn");
  EXPECT_FALSE(method_named("ISOMAP"));
  for (const MethodInfo& method : all_methods()) {
    EXPECT_EQ(info(method.method).name, method.name);
    EXPECT_EQ(method_named(method.name), method.method);
  }
}

TEST(MethodNames, AreUniqueWithTheirParametersInIds) {
  EXPECT_EQ(slug({Method::kIsomap, 6.0}), "isomap-K6");
  EXPECT_EQ(slug({Method::kLpca, std::nullopt}), "lpca");
  // One number after another must not read as a third.
  EXPECT_EQ(slug({Method::kKpcaGaussian, 1.0}), "kpca-gaussian-sigma2-1");
  std::set<std::string> slugs;
  for (const double parameter : {0.1, 0.5, 1.0, 2.0, 21.0, 40.0})
    slugs.insert(slug({Method::kKpcaGaussian, parameter}));
  EXPECT_EQ(slugs.size(), 6U);
}

TEST(MethodStarts, LeadToAMethodThatStartsFromNone) {
  for (const MethodInfo& method : all_methods()) {
    std::set<Method> seen{method.method};
    for (auto start = method.starts_from; start; start = info(*start).starts_from)
      EXPECT_TRUE(seen.insert(*start).second) << method.name;
  }
  EXPECT_EQ(info(Method::kSmacofKnn).starts_from, Method::kSmacof);
}

}  // namespace
}  // namespace mapproof
