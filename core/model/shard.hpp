#pragma once

#include <string>
#include <vector>

namespace mapproof {

/// A share of a study's tasks: every count-th of them, from the index-th on.
struct Shard {
  int index = 1;  ///< 1 <= index <= count.
  int count = 1;

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// One start of the program on a shard.
struct ShardSession {
  Shard shard = {};
  int tasks = 0;               ///< Of the whole study.
  std::string plan = {};       ///< SHA-256 of their ids, in order.
  std::string command = {};    ///< What makes the shard again.
  std::string processor = {};  ///< What it ran on.
};

/// A file of a study and the SHA-256 of what was written.
struct FileDigest {
  std::string file;  ///< Below the study's folder.
  std::string sha256;

  friend bool operator==(const FileDigest&, const FileDigest&) = default;
};

/// What one task of a shard has written.
struct TaskRecords {
  int task = 0;  ///< Counted from 1, of the whole study.
  std::string id = {};
  std::vector<FileDigest> files = {};  ///< As they are written.
};

}  // namespace mapproof
