// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/serial_chain.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cortex::toolkit {

// What a path has at one time.
struct PathSample {
    mechanics::Pose pose;
    bool trigger = false;
};

// What comes after the end of a path: the last sample stays, or the path begins again.
enum class PathEnd { Hold, Loop };

// A hand's path from a file of comma-separated values: time,x,y,z,qx,qy,qz,qw,trigger.
// Read in the setup phase, which throws cortex::Error naming line, column and remedy.
// Sampling is const, allocates nothing, and may be done from any thread at any time.
class RecordedPath {
public:
    // Loop requires that the path ends where it began.
    static RecordedPath load(const std::string& file, PathEnd end = PathEnd::Hold);
    static RecordedPath parse(std::string_view text, const std::string& name,
                              PathEnd end = PathEnd::Hold);

    // Length in seconds; the file's first sample is at 0, whatever its time says.
    double duration() const { return times_.back(); }

    // Pose with continuous speed and turning speed between the samples; the trigger of the last
    // sample. Before the path the first sample, after it the last one.
    PathSample at(double time) const;

    // True once the last sample is reached; never when the path loops.
    bool finished(double time) const { return end_ == PathEnd::Hold && time >= duration(); }

private:
    using Channels = Eigen::Matrix<double, 7, 1>;  // x y z qx qy qz qw
    struct Knot {
        Channels value;
        Channels slope;  // per second
        bool trigger = false;
    };

    RecordedPath(std::vector<double> times, std::vector<Knot> knots, PathEnd end);

    std::vector<double> times_;
    std::vector<Knot> knots_;
    PathEnd end_;
};

}  // namespace cortex::toolkit
