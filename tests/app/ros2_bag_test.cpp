// examples/ros2/mcap_to_csv.py on a bag that the test writes, and on a recorded one.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/records/ranges/range_log_forms.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

/// Little-endian bytes of MCAP's records [mcap.dev/spec], and of messages as CDR.
class BagBytes {
 public:
  template <typename Number>
  BagBytes& number(Number value) {
    using Bits =
        std::conditional_t<sizeof(Number) == 8, std::uint64_t,
                           std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint16_t>>;
    auto bits = std::bit_cast<Bits>(value);
    for (std::size_t i = 0; i < sizeof(Number); ++i, bits = static_cast<Bits>(bits >> 4 >> 4))
      bytes_ += static_cast<char>(bits & 0xFF);
    return *this;
  }
  BagBytes& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    return *this;
  }
  /// With the padding that CDR puts before a number of `size` bytes.
  BagBytes& align(std::size_t size) {
    while ((bytes_.size() - 4) % size != 0) bytes_ += '\0';
    return *this;
  }
  BagBytes& cdr_text(const std::string& value) { return align(4).text(value + '\0'); }
  BagBytes& cdr(double value) { return align(8).number(value); }
  BagBytes& cdr(std::int32_t value) { return align(4).number(value); }
  /// A stamped header of ROS 2.
  BagBytes& header(std::int32_t second, std::int32_t nanosecond, const std::string& frame) {
    bytes_ += std::string("\0\x01\0\0", 4);
    return cdr(second).cdr(nanosecond).cdr_text(frame);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(char opcode, const BagBytes& content) {
  BagBytes size;
  size.number(static_cast<std::uint64_t>(content.bytes().size()));
  return opcode + size.bytes() + content.bytes();
}

std::string schema(std::uint16_t id, const std::string& name, const std::string& definition) {
  return record('\x03', BagBytes().number(id).text(name).text("ros2msg").text(definition));
}

std::string channel(std::uint16_t id, const std::string& topic) {
  return record('\x04',
                BagBytes().number(id).number(id).text(topic).text("cdr").number(std::uint32_t{0}));
}

std::string message(std::uint16_t id, const BagBytes& data) {
  BagBytes head;
  head.number(id).number(std::uint32_t{0}).number(std::uint64_t{0}).number(std::uint64_t{0});
  BagBytes size;
  size.number(static_cast<std::uint64_t>(head.bytes().size() + data.bytes().size()));
  return '\x05' + size.bytes() + head.bytes() + data.bytes();
}

constexpr const char* kHeader =
    "\n================\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "================\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";

/// Two poses of odometry, a scan of two tags, one without any, and a message that is not known.
std::string small_bag() {
  const std::string magic = "\x89MCAP0\r\n";
  std::string bag = magic;
  bag += schema(1, "nav_msgs/msg/Odometry",
                std::string("# A pose.\nstd_msgs/Header header\nstring child_frame_id\n"
                            "geometry_msgs/PoseWithCovariance pose") +
                    kHeader +
                    "================\nMSG: geometry_msgs/PoseWithCovariance\nPose pose\n"
                    "float64[2] covariance\n================\nMSG: geometry_msgs/Pose\n"
                    "Point position\nQuaternion orientation\n================\n"
                    "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n================\n"
                    "MSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\n"
                    "float64 w 1\n");
  bag += schema(2, "my_msgs/msg/Tags",
                std::string("uint8 FAMILY=3\nstd_msgs/Header header\nTag[] tags") + kHeader +
                    "================\nMSG: my_msgs/Tag\nint32 id\nfloat64 x\nfloat64 y\n");
  bag += schema(3, "sensor_msgs/msg/Imu", "float64 x\n");
  bag += channel(1, "/odom") + channel(2, "/tags") + channel(3, "/imu");
  for (const int k : {0, 1}) {
    BagBytes pose;
    pose.header(10 + k, 500'000'000, "odom").cdr_text("base");
    for (const double value : {1.0 + k, 2.0, 0.0, 0.0, 0.0, 0.6, 0.8, 9.0, 9.0}) pose.cdr(value);
    bag += message(1, pose);
  }
  BagBytes tags, none;
  tags.header(10, 0, "base").cdr(std::int32_t{2});
  tags.cdr(std::int32_t{7}).cdr(3.0).cdr(4.0).cdr(std::int32_t{12}).cdr(0.0).cdr(-2.0);
  none.header(11, 0, "base").cdr(std::int32_t{0});
  bag += message(2, tags) + message(2, none);
  bag += message(3, BagBytes().header(0, 0, ""));
  return bag +
         record('\x02', BagBytes()
                            .number(std::uint64_t{0})
                            .number(std::uint64_t{0})
                            .number(std::uint32_t{0})) +
         magic;
}

const fs::path kScript = fs::path(MAPPROOF_SOURCE_DIR) / "examples/ros2/mcap_to_csv.py";

TEST(Ros2Bag, GivesPathsOfItsPosesAndSkipsWhatItNames) {
  const TemporaryFolder folder;
  const fs::path bag = folder.file("small.mcap", small_bag());
  const Outcome outcome =
      run_program({"/usr/bin/python3", kScript, bag, "--out", folder / "paths"});
  if (outcome.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("/imu: sensor_msgs/msg/Imu, 1 messages, skipped"), std::string::npos)
      << outcome.out;
  ByteSource source(folder / "paths/odom.tum");
  ASSERT_TRUE(is_path_text(source));
  const Trajectory path = read_path_text(source, {});
  ASSERT_EQ(path.size(), 2);
  EXPECT_EQ(path.time_s(1), 11.5);
  EXPECT_EQ(path.positions_m(1, 0), 2.0);
  EXPECT_NEAR(path.heading_rad(0), 2.0 * std::atan2(0.6, 0.8), 1e-12);
}

TEST(Ros2Bag, GivesATableOfDetectionsThatMapReads) {
  const TemporaryFolder folder;
  const fs::path bag = folder.file("small.mcap", small_bag());
  const Outcome outcome = run_program({"/usr/bin/python3", kScript, bag, "--csv", "/tags"});
  if (outcome.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const Outcome read = mapproof({"validate", folder.file("tags.csv", outcome.out), "--json"});
  ASSERT_EQ(read.exit_code, 0) << read.out;
  const nlohmann::json input = nlohmann::json::parse(read.out).at("files")[0].at("input");
  EXPECT_EQ(input.at("landmarks"), 2);
  EXPECT_EQ(input.at("sensor"), "range-bearing");
}

TEST(Ros2Bag, ThatWasRecordedGivesItsPaths) {
  const char* data = std::getenv("MAPPROOF_TRAJECTORIES");
  const fs::path bag = fs::path(data == nullptr ? "" : data) / "nav2_turtlebot.mcap";
  if (!fs::exists(bag)) GTEST_SKIP() << "MAPPROOF_TRAJECTORIES names no folder with " << bag;
  const TemporaryFolder folder;
  const Outcome outcome =
      run_program({"/usr/bin/python3", kScript, bag, "--out", folder / "paths"});
  if (outcome.error.find("python3-zstandard") != std::string::npos)
    GTEST_SKIP() << "python3-zstandard is not installed";
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const char* name : {"odom.tum", "amcl_pose.tum", "tf_odom_base_link.tum"}) {
    ByteSource source(folder / "paths" / name);
    EXPECT_GT(read_path_text(source, {}).size(), 100) << name;
  }
}

}  // namespace
}  // namespace mapproof::test
