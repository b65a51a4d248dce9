// SPDX-License-Identifier: Apache-2.0
#include "joint_points.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/event.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <istream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cortex::toolkit {

namespace {

constexpr off_t largest = 1U << 20U;  // bytes of a file

std::string joined(const std::vector<PointAxis>& axes) {
    std::string text;
    for (const PointAxis& each : axes) text += (text.empty() ? "" : ",") + each.name;
    return text;
}

// For messages: a zero would end them, and a line may be long.
std::string shown(std::string_view word) {
    std::string text{word.substr(0, 40)};
    std::ranges::replace_if(
        text, [](char each) { return static_cast<unsigned char>(each) < ' '; }, '?');
    return text;
}

// Whole and at once, as to open or read a pipe may wait for ever.
std::string contentOf(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) throw Error("there is no file " + file.string());
    struct stat found{};
    std::string text;
    const bool regular = ::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
    const bool small = found.st_size <= largest;
    if (regular && small) text.resize(static_cast<std::size_t>(found.st_size));
    const ssize_t got = ::read(descriptor, text.data(), text.size());
    ::close(descriptor);
    if (!regular) throw Error(file.string() + " is no file that can be read");
    if (!small) throw Error(file.string() + " is larger than 1 MiB");
    if (got < 0) throw Error(file.string() + " cannot be read");
    text.resize(static_cast<std::size_t>(got));
    return text;
}

// Without what spreadsheets put before the first line and at the end of each.
bool nextLine(std::istream& stream, std::string& line, std::size_t number) {
    if (!std::getline(stream, line)) return false;
    if (line.ends_with('\r')) line.pop_back();
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    return true;
}

std::string at(const std::filesystem::path& file, std::size_t line) {
    return file.string() + ":" + std::to_string(line) + ": ";
}

std::vector<double> numbersOf(std::string_view line, const std::string& place, std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const std::string_view word = line.substr(begin, end - begin);
        double number = 0;
        const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc{} || last != word.data() + word.size() || !std::isfinite(number))
            throw Error(place + "'" + shown(word) + "' is no number; write one such as 0.5");
        numbers.push_back(number);
        begin = end + 1;
    }
    if (numbers.size() == count) return numbers;
    throw Error(place + std::to_string(numbers.size()) + " numbers for " + std::to_string(count) +
                " axes");
}

void requireInRange(const std::vector<double>& pose, const std::vector<PointAxis>& axes,
                    const std::string& place) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisLimits& limits = axes[i].limits;
        if (limits.inRange(pose[i])) continue;
        const bool above = pose[i] > limits.max;
        EventText why;
        why.apart(pose[i], above ? limits.max : limits.min) << (above ? ", above " : ", below ");
        why.apart(above ? limits.max : limits.min, pose[i]);
        throw Error(place + axes[i].name + " is " + std::string{why.view()} + ", the limit of " +
                    axes[i].demand);
    }
}

void write(std::ofstream& stream, const std::vector<PointAxis>& axes, const JointPoints& points) {
    stream << joined(axes) << "\n";
    char buffer[32];
    for (std::size_t i = 0; i < points.size(); ++i) {
        const char* separator = "";
        for (const double value : points[i]) {
            const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
            stream << separator << std::string_view{buffer, result.ptr};
            separator = ",";
        }
        stream << "\n";
    }
    stream.close();
}

}  // namespace

JointPoints::JointPoints(std::size_t axes) : axes_{axes}, values_(axes * most) {}

bool JointPoints::insert(std::size_t before, std::span<const double> pose) {
    if (size_ == most) return false;
    const auto place = values_.begin() + static_cast<std::ptrdiff_t>(before * axes_);
    const auto end = values_.begin() + static_cast<std::ptrdiff_t>(size_ * axes_);
    std::move_backward(place, end, end + static_cast<std::ptrdiff_t>(axes_));
    std::ranges::copy(pose, place);
    ++size_;
    return true;
}

void JointPoints::remove(std::size_t point) {
    const auto place = values_.begin() + static_cast<std::ptrdiff_t>(point * axes_);
    const auto end = values_.begin() + static_cast<std::ptrdiff_t>(size_ * axes_);
    std::move(place + static_cast<std::ptrdiff_t>(axes_), end, place);
    --size_;
}

void JointPoints::assign(const JointPoints& other) {
    std::ranges::copy(other.values_, values_.begin());
    size_ = other.size_;
}

void writeJointPoints(const std::filesystem::path& file, const std::vector<PointAxis>& axes,
                      const JointPoints& points) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    std::filesystem::path beside = file;
    beside += ".new";
    std::filesystem::remove(beside, error);  // a pipe of this name would block
    std::ofstream stream{beside, std::ios::trunc};
    write(stream, axes, points);
    if (stream) std::filesystem::rename(beside, file, error);
    if (!stream || error)
        throw Error(file.string() + " cannot be written: give the program a folder that it may");
}

JointPoints readJointPoints(const std::filesystem::path& file, const std::vector<PointAxis>& axes) {
    std::istringstream stream{contentOf(file)};
    std::string line;
    if (!nextLine(stream, line, 1)) throw Error(file.string() + " is empty");
    if (line != joined(axes))
        throw Error(at(file, 1) + "it is for other axes; expected: " + joined(axes));
    JointPoints points{axes.size()};
    for (std::size_t number = 2; nextLine(stream, line, number); ++number) {
        if (line.empty()) continue;
        const std::string place = at(file, number);
        const std::vector<double> pose = numbersOf(line, place, axes.size());
        requireInRange(pose, axes, place);
        if (!points.insert(points.size(), pose))
            throw Error(place + "there are more than 64 points");
    }
    return points;
}

std::filesystem::path pointsFile(const std::string& files, const std::string& folder,
                                 std::string_view name) {
    const auto isOf = [](std::string_view text, std::string_view others) {
        return !text.empty() && std::ranges::all_of(text, [&](char each) {
            const bool letter = (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z');
            return letter || (each >= '0' && each <= '9') || others.find(each) != others.npos;
        });
    };
    if (!isOf(name, "-_")) throw Error("a name has letters, digits, - and _, such as pick_1");
    if (files.empty()) throw Error("the program may use no files: start it with --files FOLDER");
    if (!folder.empty() && !isOf(folder, "-_/"))
        throw Error("folder '" + folder + "' has more than letters, digits, -, _ and /");
    return std::filesystem::path{files} / std::filesystem::path{folder}.relative_path() /
           (std::string{name} + ".csv");
}

}  // namespace cortex::toolkit
