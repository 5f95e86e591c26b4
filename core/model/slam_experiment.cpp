#include "core/model/slam_experiment.hpp"

namespace mapproof {

std::string missing_sentence(const SlamDataSet& data) {
  return data.title + " is missing. " + data.source;
}

}  // namespace mapproof
