#pragma once

#include <vector>

#include "core/model/study.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/plot/figure.hpp"

namespace mapproof::test {

/// A step of a run through a room of `landmarks`, its views by the geometry of the sensor.
Measurement sample_measurement(Sensor sensor, int landmarks);

/// Methods tuned by K, by a kernel's width and by a degree.
ErrorByParameterSpec sample_parameters();

/// The figures about studies, with tame data and with data that is hard to draw.
std::vector<Figure> sample_study_figures();

}  // namespace mapproof::test
