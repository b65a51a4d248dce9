// SPDX-License-Identifier: Apache-2.0
#include "joint_points.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

namespace cortex::toolkit {

namespace {

constexpr std::uintmax_t largest = 1U << 20U;  // bytes of a file

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& each : names) text += (text.empty() ? "" : ",") + each;
    return text;
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
            throw Error(place + "'" + std::string{word} + "' is no number; write one such as 0.5");
        numbers.push_back(number);
        begin = end + 1;
    }
    if (numbers.size() == count) return numbers;
    throw Error(place + std::to_string(numbers.size()) + " numbers for " + std::to_string(count) +
                " axes");
}

void write(std::ofstream& stream, const std::vector<std::string>& names,
           const JointPoints& points) {
    stream << joined(names) << "\n";
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

void writeJointPoints(const std::filesystem::path& file, const std::vector<std::string>& names,
                      const JointPoints& points) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    std::filesystem::path beside = file;
    beside += ".new";
    std::ofstream stream{beside, std::ios::trunc};
    write(stream, names, points);
    if (stream) std::filesystem::rename(beside, file, error);
    if (!stream || error)
        throw Error(file.string() + " cannot be written: give the program a folder that it may");
}

JointPoints readJointPoints(const std::filesystem::path& file,
                            const std::vector<std::string>& names) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream stream{file};
    if (error || !stream) throw Error("there is no file " + file.string());
    if (size > largest) throw Error(file.string() + " is larger than 1 MiB");
    std::string line;
    std::getline(stream, line);
    if (line != joined(names))
        throw Error(at(file, 1) + "it is for other axes; expected: " + joined(names));
    JointPoints points{names.size()};
    for (std::size_t number = 2; std::getline(stream, line); ++number) {
        if (line.empty()) continue;
        const std::string place = at(file, number);
        if (!points.insert(points.size(), numbersOf(line, place, names.size())))
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
