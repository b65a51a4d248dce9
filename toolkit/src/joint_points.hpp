// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/axis_limits.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::toolkit {

// Poses of some axes, one after the other, without a gap in memory that is reserved beforehand: up
// to `most`, in rad or m. What changes it allocates nothing.
class JointPoints {
public:
    static constexpr std::size_t most = 64;

    explicit JointPoints(std::size_t axes = 0);

    std::size_t size() const { return size_; }
    std::span<const double> operator[](std::size_t point) const {
        return std::span{values_}.subspan(point * axes_, axes_);
    }
    bool insert(std::size_t before, std::span<const double> pose);  // false: it is full
    void remove(std::size_t point);
    void clear() { size_ = 0; }
    void assign(const JointPoints& other);  // of as many axes

    template <class Archive>
    void keep(Archive& archive) {
        archive & values_ & size_;
    }

private:
    std::size_t axes_ = 0, size_ = 0;
    std::vector<double> values_;
};

// An axis of a file: its name with unit, and the simplex whose limits its points keep.
struct PointAxis {
    std::string name, demand;
    AxisLimits limits;
};

// A file of comma-separated values: a line of names, then one for each point. Both throw Error
// with file, line and remedy. The file is whole or not there: it is written beside and renamed.
void writeJointPoints(const std::filesystem::path& file, const std::vector<PointAxis>& axes,
                      const JointPoints& points);
// Refused: names other than these, numbers that are none or out of range, more than `most` points.
// Lines may end as in spreadsheets.
JointPoints readJointPoints(const std::filesystem::path& file, const std::vector<PointAxis>& axes);

// Where a file of this name lies; throws Error where the name or the folder leads elsewhere, or the
// program was given no folder of files.
std::filesystem::path pointsFile(const std::string& files, const std::string& folder,
                                 std::string_view name);

}  // namespace cortex::toolkit
