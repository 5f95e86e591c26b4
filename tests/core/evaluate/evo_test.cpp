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

/// Numbers for the test data of evo (github.com/MichaelGrupp/evo), whose folder
/// MAPPROOF_TRAJECTORIES names: APE and RPE of the translation part, poses within 0.01 s of each
/// other.
struct Published {
  const char* ground_truth;
  const char* estimate;
  Eigen::Index poses;
  std::optional<FrameAlignment> alignment;  ///< Empty: relative errors, without alignment.
  PairSpacing spacing;
  PairChoice pairs;
  std::optional<Plane> plane;  ///< Empty: in space.
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
constexpr std::nullopt_t kRelative = std::nullopt, kSpace = std::nullopt;
constexpr auto kConsecutive = PairChoice::kConsecutive, kAll = PairChoice::kAll;
constexpr auto kXy = Plane::kXy, kXz = Plane::kXz, kYz = Plane::kYz;

/// Printed by evo, commit 26d0953.
const std::array kPublished = {
    Published{kFr1, kRgbd, 785, kNone, kMetre, kConsecutive, kSpace, {0.0200794183785, 0.0180625184307, 0.0165177561733, 0.043289433884}},
    Published{kFr1, kRgbd, 785, kOrigin, kMetre, kConsecutive, kSpace, {0.0193679199417, 0.01734889918, 0.0158661006578, 0.0421766788668}},
    Published{kFr1, kRgbd, 785, kRigid, kMetre, kConsecutive, kSpace, {0.0134700888497, 0.0120244987091, 0.0111831867751, 0.034759545895}},
    Published{kFr1, kRgbd, 785, kSimilarity, kMetre, kConsecutive, kSpace, {0.0133893849042, 0.0119868896249, 0.0111338990908, 0.0348461448523}},
    Published{kFr1, kRgbd, 785, kRelative, kMetre, kConsecutive, kSpace, {0.0226118959775, 0.0219296541298, 0.0207089181608, 0.0320102100638}},
    Published{kFr1, kRgbd, 785, kRelative, kHundredPoses, kConsecutive, kSpace, {0.015710875264, 0.0139757375224, 0.0116908148008, 0.024142836313}},
    Published{kFr1, kMono, 32, kNone, kMetre, kConsecutive, kSpace, {2.02514154569, 2.02366455355, 2.00167087745, 2.17624585852}},
    Published{kFr1, kMono, 32, kOrigin, kMetre, kConsecutive, kSpace, {0.0286272648602, 0.0266317014266, 0.0261716889946, 0.0537339385427}},
    Published{kFr1, kMono, 32, kRigid, kMetre, kConsecutive, kSpace, {0.0243016322776, 0.0225982929874, 0.0210907781769, 0.0427347976768}},
    Published{kFr1, kMono, 32, kSimilarity, kMetre, kConsecutive, kSpace, {0.00975458189869, 0.00821869858882, 0.00790907025995, 0.0279240017341}},
    Published{kFr1, kMono, 32, kRelative, kMetre, kConsecutive, kSpace, {0.0282690077943, 0.0264470875656, 0.0264470875656, 0.0364314934553}},
    Published{kFr2, kFr2Orb, 2174, kNone, kMetre, kConsecutive, kSpace, {3.1739935419, 2.9496938876, 2.59464246498, 5.06673506228}},
    Published{kFr2, kFr2Orb, 2174, kOrigin, kMetre, kConsecutive, kSpace, {0.0420155117134, 0.034069931768, 0.0284889552046, 0.0843142169747}},
    Published{kFr2, kFr2Orb, 2174, kRigid, kMetre, kConsecutive, kSpace, {0.00811897756205, 0.00749177687022, 0.00741462982932, 0.0242995936944}},
    Published{kFr2, kFr2Orb, 2174, kSimilarity, kMetre, kConsecutive, kSpace, {0.00612316303016, 0.00558619731871, 0.00530522507585, 0.0214767855628}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kMetre, kConsecutive, kSpace, {0.0116534753084, 0.0105566637854, 0.00985263599647, 0.0219340223682}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kHundredPoses, kConsecutive, kSpace, {0.0109444742064, 0.00999413180371, 0.0084444620823, 0.0242904224084}},
    Published{kKitti, kKittiOrb, 4541, kNone, kMetre, kConsecutive, kSpace, {7.79028888266, 7.01175040167, 6.80163167456, 13.4585088074}},
    Published{kKitti, kKittiOrb, 4541, kOrigin, kMetre, kConsecutive, kSpace, {7.79030522524, 7.01176462781, 6.80163255124, 13.4585127115}},
    Published{kKitti, kKittiOrb, 4541, kRigid, kMetre, kConsecutive, kSpace, {1.30344971457, 1.15699712854, 1.06562476956, 3.58794912068}},
    Published{kKitti, kKittiOrb, 4541, kSimilarity, kMetre, kConsecutive, kSpace, {0.937709073611, 0.872692631969, 0.844691013486, 2.69349986361}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kMetre, kConsecutive, kSpace, {0.0456922046052, 0.02768887088, 0.020380463421, 0.629549800403}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kHundredPoses, kConsecutive, kSpace, {1.05325607669, 0.916762133395, 0.863190027726, 2.94953453743}},
    Published{kV102, kV102Estimate, 798, kNone, kMetre, kConsecutive, kSpace, {2.55417404622, 2.50728788846, 2.37786067816, 3.65515203181}},
    Published{kV102, kV102Estimate, 798, kOrigin, kMetre, kConsecutive, kSpace, {0.153678891584, 0.140104646073, 0.147174510428, 0.321954020819}},
    Published{kV102, kV102Estimate, 798, kRigid, kMetre, kConsecutive, kSpace, {0.0917271152069, 0.0815216219462, 0.0779119490195, 0.255816733814}},
    Published{kV102, kV102Estimate, 798, kSimilarity, kMetre, kConsecutive, kSpace, {0.083841388043, 0.0748410847826, 0.0719451786662, 0.226651792383}},
    Published{kV102, kV102Estimate, 798, kRelative, kMetre, kConsecutive, kSpace, {0.0532343423075, 0.044630687882, 0.0357611944301, 0.140637437062}},
    Published{kV102, kV102Estimate, 798, kRelative, kHundredPoses, kConsecutive, kSpace, {0.147560867642, 0.140988896987, 0.135147975328, 0.226364259664}},
};

/// Of every pair and in one plane, as evo_by_hand.py beside this file prints them: in numpy, from
/// evo's definitions. Of consecutive pairs and in space it prints the numbers above.
const std::array kByHand = {
    Published{kFr1, kRgbd, 785, kRelative, kMetre, kAll, kSpace, {0.019299902562, 0.0168972793544, 0.0156815416065, 0.0459381128985}},
    Published{kFr1, kRgbd, 785, kRelative, kHundredPoses, kAll, kSpace, {0.0162984391563, 0.0144703263356, 0.0138779431127, 0.0415011353921}},
    Published{kFr1, kRgbd, 785, kRigid, kMetre, kConsecutive, kXy, {0.0125678611894, 0.0110095193227, 0.0102331348187, 0.0344998115675}},
    Published{kFr1, kRgbd, 785, kRelative, kMetre, kAll, kXy, {0.0184178294957, 0.0163868904616, 0.015143068133, 0.0484302524602}},
    Published{kFr1, kRgbd, 785, kRelative, kHundredPoses, kConsecutive, kXy, {0.0144262633171, 0.0120745701505, 0.0066504500967, 0.0232164232573}},
    Published{kFr1, kRgbd, 785, kRigid, kMetre, kConsecutive, kXz, {0.0111169269819, 0.00945757492785, 0.00852014812136, 0.0298851877291}},
    Published{kFr1, kRgbd, 785, kRelative, kMetre, kAll, kXz, {0.0152251227531, 0.0131001274427, 0.0116002530578, 0.0375383771814}},
    Published{kFr1, kRgbd, 785, kRelative, kHundredPoses, kConsecutive, kXz, {0.0125275484279, 0.0112446588377, 0.0111046158022, 0.0186809352099}},
    Published{kFr1, kRgbd, 785, kRigid, kMetre, kConsecutive, kYz, {0.00901938949381, 0.00771243097369, 0.00682167839994, 0.0312474379587}},
    Published{kFr1, kRgbd, 785, kRelative, kMetre, kAll, kYz, {0.0141154654501, 0.0121697610532, 0.0116180088789, 0.038538097252}},
    Published{kFr1, kRgbd, 785, kRelative, kHundredPoses, kConsecutive, kYz, {0.0118280366702, 0.0102652759258, 0.00811545992287, 0.0197355235585}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kMetre, kAll, kSpace, {0.0116726733727, 0.0107005115699, 0.0103791127433, 0.0309015569046}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kHundredPoses, kAll, kSpace, {0.0120407696984, 0.0105592009221, 0.00964329794685, 0.0436373985548}},
    Published{kFr2, kFr2Orb, 2174, kRigid, kMetre, kConsecutive, kXy, {0.00724901543086, 0.0065347857267, 0.00636377532493, 0.0236062175683}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kMetre, kAll, kXy, {0.72370517345, 0.623326896406, 0.519192954469, 1.85433146037}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kHundredPoses, kConsecutive, kXy, {0.804922408988, 0.624933175008, 0.476351635862, 2.30303980927}},
    Published{kFr2, kFr2Orb, 2174, kRigid, kMetre, kConsecutive, kXz, {0.00565961868294, 0.00494488325849, 0.00454390258456, 0.0182853538706}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kMetre, kAll, kXz, {0.929443430689, 0.783031164054, 0.701505395252, 1.76646453576}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kHundredPoses, kConsecutive, kXz, {0.818474830656, 0.684677932141, 0.668946394787, 2.09457919051}},
    Published{kFr2, kFr2Orb, 2174, kRigid, kMetre, kConsecutive, kYz, {0.00687430614337, 0.00611252545529, 0.00583608937766, 0.0222848864821}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kMetre, kAll, kYz, {0.968291989076, 0.889072237252, 0.929190862544, 2.37843587293}},
    Published{kFr2, kFr2Orb, 2174, kRelative, kHundredPoses, kConsecutive, kYz, {0.839449717027, 0.699021308771, 0.622153473324, 2.34757025059}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kMetre, kAll, kSpace, {0.04393235624, 0.025251271368, 0.0168029415782, 0.517045280995}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kHundredPoses, kAll, kSpace, {1.1491921365, 0.906325348839, 0.783228807601, 11.0060142701}},
    Published{kKitti, kKittiOrb, 4541, kRigid, kMetre, kConsecutive, kXy, {0.86766656608, 0.739650950347, 0.643889836931, 2.15735152438}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kMetre, kAll, kXy, {0.334196748231, 0.278242923501, 0.274045273499, 1.12634122644}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kHundredPoses, kConsecutive, kXy, {11.6187526361, 6.5266888006, 2.8317815764, 48.7477707163}},
    Published{kKitti, kKittiOrb, 4541, kRigid, kMetre, kConsecutive, kXz, {1.18030369008, 1.01303055752, 0.980452323529, 3.57365129953}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kMetre, kAll, kXz, {0.047123426676, 0.0304900538371, 0.0254797230127, 0.516856825136}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kHundredPoses, kConsecutive, kXz, {2.15309001531, 1.72888360648, 1.18634681206, 5.05903787344}},
    Published{kKitti, kKittiOrb, 4541, kRigid, kMetre, kConsecutive, kYz, {1.11892816842, 0.991164427306, 0.943969857828, 3.33520987775}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kMetre, kAll, kYz, {0.356135479022, 0.243659152322, 0.157694854447, 2.06435845524}},
    Published{kKitti, kKittiOrb, 4541, kRelative, kHundredPoses, kConsecutive, kYz, {5.02553732424, 3.65098763335, 2.65105929428, 15.8445707251}},
    Published{kV102, kV102Estimate, 798, kRelative, kMetre, kAll, kSpace, {0.0566659727441, 0.0446273280573, 0.034637316503, 0.245869569989}},
    Published{kV102, kV102Estimate, 798, kRelative, kHundredPoses, kAll, kSpace, {0.146717719304, 0.126917861697, 0.113625853723, 0.462895733123}},
    Published{kV102, kV102Estimate, 798, kRigid, kMetre, kConsecutive, kXy, {0.0877753723872, 0.0765638112472, 0.0728709399704, 0.255731821935}},
    Published{kV102, kV102Estimate, 798, kRelative, kMetre, kAll, kXy, {0.0589550989028, 0.0467650926382, 0.036754971528, 0.261537481408}},
    Published{kV102, kV102Estimate, 798, kRelative, kHundredPoses, kConsecutive, kXy, {0.142392859692, 0.130866611173, 0.117130298577, 0.259663182952}},
    Published{kV102, kV102Estimate, 798, kRigid, kMetre, kConsecutive, kXz, {0.0753810767866, 0.0610264197523, 0.0488053202106, 0.251286341856}},
    Published{kV102, kV102Estimate, 798, kRelative, kMetre, kAll, kXz, {0.603919452114, 0.496136081019, 0.412645500305, 1.38085364352}},
    Published{kV102, kV102Estimate, 798, kRelative, kHundredPoses, kConsecutive, kXz, {0.944372327486, 0.735090669587, 0.410461243843, 1.55087419015}},
    Published{kV102, kV102Estimate, 798, kRigid, kMetre, kConsecutive, kYz, {0.0586592242799, 0.0516396115667, 0.046857934841, 0.134216533232}},
    Published{kV102, kV102Estimate, 798, kRelative, kMetre, kAll, kYz, {0.426759627495, 0.320620789177, 0.224127330403, 1.31079551485}},
    Published{kV102, kV102Estimate, 798, kRelative, kHundredPoses, kConsecutive, kYz, {0.710643189731, 0.600400810017, 0.465543383346, 1.36269663884}},
};

class Evo : public testing::TestWithParam<Published> {};

TEST_P(Evo, ReportsTheSameNumbers) {
  const char* named = std::getenv("MAPPROOF_TRAJECTORIES");
  if (named == nullptr)
    GTEST_SKIP() << "MAPPROOF_TRAJECTORIES does not name the folder of evo's test data";
  const std::filesystem::path folder = named;
  const Published& published = GetParam();
  ByteSource ground_truth(folder / published.ground_truth), estimate(folder / published.estimate);
  PathEvaluationOptions options{.alignment = published.alignment.value_or(kNone),
                                .pairs = published.pairs,
                                .plane = published.plane};
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
INSTANTIATE_TEST_SUITE_P(ByHand, Evo, testing::ValuesIn(kByHand));

}  // namespace
}  // namespace mapproof
