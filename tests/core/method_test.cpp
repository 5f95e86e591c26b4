#include "core/model/method.hpp"

#include <set>
#include <string>
#include <thread>
#include <vector>

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

TEST(MethodsOfOthers, AreTheSameForTheSameDescription) {
  const ExternalMethodInfo description{
      .name = "umap", .label = "UMAP", .source = "McInnes 2018", .symbol = "n2"};
  const Method umap = external_method(description);
  EXPECT_EQ(external_method(description), umap);
  EXPECT_EQ(description_of_external(umap), description);
  EXPECT_FALSE(description_of_external(Method::kSde));
  ExternalMethodInfo other = description;
  other.label = "UMAP again";
  EXPECT_NE(external_method(other), umap);
  EXPECT_GT(umap, Method::kSde);
  EXPECT_EQ(info(umap).label, "UMAP");
  EXPECT_FALSE(on_graph(umap));
  EXPECT_FALSE(method_named("umap"));
  EXPECT_EQ(slug({umap, 15.0}), "umap-n2-15");
  EXPECT_EQ(parameter_text({umap, 15.0}), "n2 = 15");
}

TEST(MethodsOfOthers, AreFoundByManyThreads) {
  std::vector<std::thread> threads;
  std::vector<std::vector<Method>> found(4);
  for (std::vector<Method>& mine : found)
    threads.emplace_back([&mine] {
      for (int i = 0; i < 500; ++i) {
        mine.push_back(external_method({.name = "m" + std::to_string(i), .label = "Of a thread"}));
        EXPECT_EQ(info(mine.back()).name, "m" + std::to_string(i));
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<Method>& mine : found) EXPECT_EQ(mine, found[0]);
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
