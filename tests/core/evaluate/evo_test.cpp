#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "core/evaluate/path_evaluation.hpp"
#include "core/records/evaluations/space_path_text.hpp"

namespace mapproof {
namespace {

/// Numbers of evo (github.com/MichaelGrupp/evo, commit 26d0953) for its own test data, whose
/// folder MAPPROOF_TRAJECTORIES names: metrics.APE and metrics.RPE of the translation part, poses
/// within 0.01 s of each other.
struct Published {
  const char* ground_truth;
  const char* estimate;
  Eigen::Index poses;
  std::optional<FrameAlignment> alignment;  ///< Empty: relative errors, without alignment.
  PairSpacing spacing;
  std::array<double, 4> values;  ///< RMSE, mean, median, maximum [m].
};

constexpr PairSpacing kMetre{1.0, PairUnit::kMetres};
constexpr PairSpacing kHundredPoses{100.0, PairUnit::kPoses};
constexpr const char* kFr1 = "freiburg1_xyz-groundtruth.txt";
constexpr const char* kRgbd = "freiburg1_xyz-rgbdslam.txt";
constexpr const char* kMono = "freiburg1_xyz-ORB_kf_mono.txt";
constexpr const char* kFr2 = "fr2_desk_groundtruth.txt";
constexpr const char* kFr2Orb = "fr2_desk_ORB.txt";
constexpr const char* kKitti = "KITTI_00_gt.txt";
constexpr const char* kKittiOrb = "KITTI_00_ORB.txt";
constexpr const char* kV102 = "V102_groundtruth.csv";
constexpr const char* kV102Estimate = "V102.txt";

constexpr auto kNone = FrameAlignment::kNone;
constexpr auto kOrigin = FrameAlignment::kFirstPose;
constexpr auto kRigid = FrameAlignment::kRigid;
constexpr auto kSimilarity = FrameAlignment::kSimilarity;
constexpr std::nullopt_t kRelative = std::nullopt;

const std::array kPublished = {
    Published{kFr1, kRgbd, 785, kNone, kMetre, {0.0200794183785, 0.0180625184307, 0.0165177561733, 0.043289433884}},
    Published{kFr1, kRgbd, 785, kOrigin, kMetre, {0.0193679199417, 0.01734889918, 0.0158661006578, 0.0421766788668}},
    Published{kFr1, kRgbd, 785, kRigid, kMetre, {0.0134700888497, 0.0120244987091, 0.0111831867751, 0.034759545895}},
    Published{kFr1, kRgbd, 785, kSimilarity, kMetre, {0.0133893849042, 0.0119868896249, 0.0111338990908, 0.0348461448523}},
    Published{kFr1, kRgbd, 785, kRelative, kMetre, {0.0226118959775, 0.0219296541298, 0.0207089181608, 0.0320102100638}},
    Published{kFr1, kRgbd, 785, kRelative, kHundredPoses, {0.015710875264, 0.0139757375224, 0.0116908148008, 0.024142836313}},
    Published{kFr1, kMono, 32, kNone, kMetre, {2.02514154569, 2.02366455355, 2.00167087745, 2.17624585852}},
    Published{kFr1, kMono, 32, kOrigin, kMetre, {0.0286272648602, 0.0266317014266, 0.0261716889946, 0.0537339385427}},
    Published{kFr1, kMono, 32, kRigid, kMetre, {0.0243016322776, 0.0225982929874, 0.0210907781769, 0.0427347976768}},
    Published{kFr1, kMono, 32, kSimilarity, kMetre, {0.00975458189869, 0.00821869858882, 0.00790907025995, 0.0279240017341}},
    Published{kFr1, kMono, 32, kRelative, kMetre, {0.0282690077943, 0.0264470875656, 0.0264470875656, 0.0364314934553}},
    Published{kFr2, kFr2Orb, 2174, kNone, kMetre, {3.1739935419, 2.9496938876, 2.59464246498, 5.06673506228}},
    Published{kFr2, kFr2Orb, 2174, kOrigin, kMetre, {0.0420155117134, 0.034069931768, 0.0284889552046, 0.0843142169747}},
    Published{kFr2, kFr2Orb, 2174, kRigid, kMetre, {0.00811897756205, 0.00749177687022, 0.00741462982932, 0.0242995936944}},
    Published{kFr2, kFr2Orb, 2174, kSimilarity, kMetre, {0.00612316303016, 0.00558619731871, 0.00530522507585, 0.0214767855628}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kMetre, {0.0116534753084, 0.0105566637854, 0.00985263599647, 0.0219340223682}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kHundredPoses, {0.0109444742064, 0.00999413180371, 0.0084444620823, 0.0242904224084}},
    Published{kKitti, kKittiOrb, 4541, kNone, kMetre, {7.79028888266, 7.01175040167, 6.80163167456, 13.4585088074}},
    Published{kKitti, kKittiOrb, 4541, kOrigin, kMetre, {7.79030522524, 7.01176462781, 6.80163255124, 13.4585127115}},
    Published{kKitti, kKittiOrb, 4541, kRigid, kMetre, {1.30344971457, 1.15699712854, 1.06562476956, 3.58794912068}},
    Published{kKitti, kKittiOrb, 4541, kSimilarity, kMetre, {0.937709073611, 0.872692631969, 0.844691013486, 2.69349986361}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kMetre, {0.0456922046052, 0.02768887088, 0.020380463421, 0.629549800403}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kHundredPoses, {1.05325607669, 0.916762133395, 0.863190027726, 2.94953453743}},
    Published{kV102, kV102Estimate, 798, kNone, kMetre, {2.55417404622, 2.50728788846, 2.37786067816, 3.65515203181}},
    Published{kV102, kV102Estimate, 798, kOrigin, kMetre, {0.153678891584, 0.140104646073, 0.147174510428, 0.321954020819}},
    Published{kV102, kV102Estimate, 798, kRigid, kMetre, {0.0917271152069, 0.0815216219462, 0.0779119490195, 0.255816733814}},
    Published{kV102, kV102Estimate, 798, kSimilarity, kMetre, {0.083841388043, 0.0748410847826, 0.0719451786662, 0.226651792383}},
    Published{kV102, kV102Estimate, 798, kRelative, kMetre, {0.0532343423075, 0.044630687882, 0.0357611944301, 0.140637437062}},
    Published{kV102, kV102Estimate, 798, kRelative, kHundredPoses, {0.147560867642, 0.140988896987, 0.135147975328, 0.226364259664}},
};

class Evo : public testing::TestWithParam<Published> {};

TEST_P(Evo, ReportsTheSameNumbers) {
  const char* named = std::getenv("MAPPROOF_TRAJECTORIES");
  if (named == nullptr)
    GTEST_SKIP() << "MAPPROOF_TRAJECTORIES does not name the folder of evo's test data";
  const std::filesystem::path folder = named;
  const Published& published = GetParam();
  ByteSource ground_truth(folder / published.ground_truth), estimate(folder / published.estimate);
  PathEvaluationOptions options{.alignment = published.alignment.value_or(kNone)};
  if (!published.alignment) options.spacings = {published.spacing};
  const PathEvaluation result =
      evaluate_path(read_space_path(ground_truth), read_space_path(estimate), options);
  EXPECT_EQ(result.poses.size(), published.poses);
  const ErrorStatistics found = error_statistics(
      published.alignment ? result.poses.error_m : result.relative.at(0).error_m);
  // The published numbers have 12 digits.
  const std::array values = {found.rmse, found.mean, found.median, found.maximum};
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], published.values[i], 1e-9 * published.values[i]) << "number " << i;
}

INSTANTIATE_TEST_SUITE_P(TestData, Evo, testing::ValuesIn(kPublished));

}  // namespace
}  // namespace mapproof
