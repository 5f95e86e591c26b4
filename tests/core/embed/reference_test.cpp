// Embeddings of scikit-learn, see tests/data/reference/export_sklearn.py. Another folder of them is
// compared with the library with MAPPROOF_REFERENCE=FOLDER.
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/SVD>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/embed/embedder.hpp"
#include "core/records/observations/observations.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<fs::path> references() {
  const char* other = std::getenv("MAPPROOF_REFERENCE");
  const fs::path folder =
      other != nullptr ? fs::path(other) : fs::path(MAPPROOF_TEST_DATA) / "reference";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

Points points_of(const json& rows) {
  Points points(std::ssize(rows), 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) << rows[static_cast<std::size_t>(i)][0].get<double>(),
        rows[static_cast<std::size_t>(i)][1].get<double>();
  return points;
}

/// Largest difference after the best signs of the columns; after the best rotation or reflection
/// where the two columns belong to one eigenvalue. No translation, no scale.
double gauge_gap(const Embedding& ours, const Points& theirs) {
  const double first = std::abs(ours.spectrum(0));
  const double apart = std::abs(ours.spectrum(0) - ours.spectrum(1));
  Eigen::Matrix2d gauge = Eigen::Matrix2d::Identity();
  if (apart <= 1e-6 * first) {
    const Eigen::Matrix2d product = ours.coordinates.transpose() * theirs;
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    gauge = svd.matrixU() * svd.matrixV().transpose();
  } else {
    for (Eigen::Index k = 0; k < 2; ++k)
      if (ours.coordinates.col(k).dot(theirs.col(k)) < 0.0) gauge(k, k) = -1.0;
  }
  return (ours.coordinates * gauge - theirs).cwiseAbs().maxCoeff();
}

TEST(Reference, AgreesWithScikitLearnUpToSign) {
  const std::vector<fs::path> files = references();
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const json reference = json::parse(read_file(file));
    const std::optional<Sensor> sensor = sensor_named(reference.at("sensor").get<std::string>());
    const fs::path observations =
        file.parent_path() / reference.at("observations").get<std::string>();
    const ObservationHistory history = read_observations(observations, sensor).history;
    EmbedderOptions options;
    options.smacof = {.relative_fall = 1e-12, .max_iterations = 3000};  // as the script goes
    HistoryEmbedder embedder(history, history.steps(), options);
    for (const json& item : reference.at("embeddings")) {
      MethodSetting setting{*method_named(item.at("method").get<std::string>()), std::nullopt};
      if (!item.at("parameter").is_null()) setting.parameter = item.at("parameter").get<double>();
      const Embedding ours = embedder.embed(setting);
      const Points theirs = points_of(item.at("coordinates"));
      ASSERT_EQ(ours.coordinates.rows(), theirs.rows());
      EXPECT_LE(gauge_gap(ours, theirs), 1e-7 * theirs.cwiseAbs().maxCoeff())
          << file << " " << slug(setting);
    }
    const Embedding smacof = embedder.embed({Method::kSmacof, std::nullopt});
    EXPECT_LE(*smacof.stress, reference.at("smacof_stress").get<double>() * (1.0 + 1e-6)) << file;
  }
}

}  // namespace
}  // namespace mapproof
