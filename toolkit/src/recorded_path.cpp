// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/recorded_path.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

namespace cortex::toolkit {
namespace {

constexpr std::string_view headerLine = "time,x,y,z,qx,qy,qz,qw,trigger";
constexpr std::array<std::string_view, 9> columnNames = {"time", "x",  "y",  "z",      "qx",
                                                         "qy",   "qz", "qw", "trigger"};
constexpr std::size_t triggerColumn = columnNames.size() - 1;
constexpr std::uintmax_t largestFile = 64 << 20;
constexpr std::size_t mostFindings = 20;
constexpr double largestTime = 1e6;        // s
constexpr double largestPosition = 1e3;    // m
constexpr double leastInterval = 1e-6;     // s
constexpr double loopGap = 1e-3;           // m or rad between the last pose and the first
constexpr double leastTurnCosine = 0.866;  // of half the turn between samples: 60 degrees

using Row = std::array<double, columnNames.size()>;

// Finds faults and remembers where; line and column count from 1.
class Findings {
public:
    explicit Findings(std::string file) : file_(std::move(file)) {}

    void add(std::size_t line, std::size_t column, const std::string& text) {
        if (++count_ > mostFindings) return;
        text_ += "\n  " + file_ + ":" + std::to_string(line);
        if (column > 0) text_ += ", column " + std::to_string(column);
        if (column > 0) text_ += " (" + std::string(columnNames[column - 1]) + ")";
        text_ += ": " + text;
    }
    bool any() const { return count_ > 0; }

    [[noreturn]] void refuse() const {
        std::string text = "recorded path refused:" + text_;
        if (count_ > mostFindings) {
            text += "\n  and " + std::to_string(count_ - mostFindings) + " more like these";
        }
        throw Error(text);
    }

private:
    std::string file_;
    std::string text_;
    std::size_t count_ = 0;
};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Part of a foreign file for a message: short, and without control characters.
std::string quoted(std::string_view text) {
    std::string result = "'";
    for (const char c : text.substr(0, 24)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > 24 ? "...'" : "'");
}

std::optional<double> toNumber(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

void checkRange(double value, std::size_t column, std::size_t line, Findings& findings) {
    if (column == 0 && std::abs(value) > largestTime) {
        findings.add(line, 1, "beyond 1e6 s: give the time in seconds");
    } else if (column >= 1 && column <= 3 && std::abs(value) > largestPosition) {
        findings.add(line, column + 1, "beyond 1000 m: give the position in metres");
    } else if (column == triggerColumn && value != 0 && value != 1) {
        findings.add(line, column + 1, "neither 0 nor 1: give 1 while pressed, otherwise 0");
    }
}

std::optional<Row> parseRow(std::string_view text, std::size_t line, Findings& findings) {
    Row row{};
    const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
    if (commas + 1 != row.size()) {
        findings.add(line, 0,
                     "has " + std::to_string(commas + 1) + " values: give " +
                         std::to_string(row.size()) + " (" + std::string(headerLine) + ")");
        return std::nullopt;
    }
    bool good = true;
    for (std::size_t column = 0; column < row.size(); ++column) {
        const auto comma = text.find(',');
        const std::string_view field = trimmed(text.substr(0, comma));
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
        if (const auto value = toNumber(field)) {
            row[column] = *value;
            checkRange(*value, column, line, findings);
        } else {
            findings.add(line, column + 1,
                         quoted(field) + " is no finite number: write it like -0.125");
            good = false;
        }
    }
    return good ? std::optional(row) : std::nullopt;
}

double cosine(const Row& a, const Row& b) {
    double sum = 0;
    for (std::size_t i = 4; i < triggerColumn; ++i) sum += a[i] * b[i];
    return sum;
}

// Brings the quaternion to length 1 and to the side of the one before: q and -q are one rotation.
bool normalize(Row& row, const Row* before) {
    const double length = std::sqrt(cosine(row, row));
    if (!(std::abs(length - 1) < 0.01)) return false;
    const double sign = before != nullptr && cosine(row, *before) < 0 ? -1 : 1;
    for (std::size_t i = 4; i < triggerColumn; ++i) row[i] *= sign / length;
    return true;
}

void append(Row row, std::size_t line, std::vector<Row>& rows, Findings& findings) {
    const Row* before = rows.empty() ? nullptr : &rows.back();
    if (!normalize(row, before)) {
        findings.add(line, 0, "qx, qy, qz, qw is no unit quaternion: give it the length 1");
        return;
    }
    if (before != nullptr && !(row[0] - (*before)[0] >= leastInterval)) {
        findings.add(line, 1, "time does not rise: give samples in order, 1 us apart at least");
    }
    if (before != nullptr && cosine(row, *before) < leastTurnCosine) {
        findings.add(line, 0, "turns by more than 60 degrees since the last sample: sample faster");
    }
    rows.push_back(row);
}

// The lines that count, after the header; comments and empty lines are passed over.
std::vector<Row> parseRows(std::string_view text, Findings& findings) {
    std::vector<Row> rows;
    bool headerSeen = false;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const auto newline = text.find('\n');
        const std::string_view content = trimmed(text.substr(0, newline));
        text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
        if (content.empty() || content.front() == '#') continue;
        if (!headerSeen) {
            headerSeen = true;
            if (content == headerLine) continue;
            findings.add(line, 0,
                         "expected the header '" + std::string(headerLine) + "', found " +
                             quoted(content) + ": put it above the samples");
            return rows;
        }
        if (const auto row = parseRow(content, line, findings)) {
            append(*row, line, rows, findings);
        }
    }
    if (rows.size() < 2 && !findings.any()) {
        findings.add(1, 0, "has " + std::to_string(rows.size()) + " samples: give at least 2");
    }
    return rows;
}

void checkClosed(const std::vector<Row>& rows, Findings& findings) {
    const Row& first = rows.front();
    const Row& last = rows.back();
    bool closed = std::abs(cosine(first, last)) >= std::cos(loopGap / 2);
    for (std::size_t i = 1; i <= 3; ++i) closed = closed && std::abs(first[i] - last[i]) <= loopGap;
    if (!closed) {
        findings.add(1, 0,
                     "does not end where it began, so a loop would jump: end within 1 mm and "
                     "0.001 rad of the start, or do not loop");
    }
}

std::string readFile(const std::string& file) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::is_regular_file(status)) {
        throw Error(file + ": no such file that can be read as a path: give a CSV file");
    }
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > largestFile) {
        throw Error(file + ": larger than 64 MiB: sample slower or cut the path");
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text(static_cast<std::size_t>(size), '\0');
    if (!stream.read(text.data(), static_cast<std::streamsize>(text.size()))) {
        throw Error(file + ": cannot be read: check its permissions");
    }
    return text;
}

}  // namespace

RecordedPath RecordedPath::load(const std::string& file, PathEnd end) {
    return parse(readFile(file), file, end);
}

// The slopes are those of a Catmull-Rom spline (E. Catmull, R. Rom, A class of local interpolating
// splines, 1974), for uneven times too; the path begins and ends at rest.
RecordedPath RecordedPath::parse(std::string_view text, const std::string& name, PathEnd end) {
    Findings findings(name);
    const std::vector<Row> rows = parseRows(text, findings);
    if (!findings.any() && end == PathEnd::Loop) checkClosed(rows, findings);
    if (findings.any()) findings.refuse();

    std::vector<double> times(rows.size());
    std::vector<Knot> knots(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        times[i] = rows[i][0] - rows[0][0];
        knots[i].value = Eigen::Map<const Channels>(&rows[i][1]);
        knots[i].slope = Channels::Zero();
        knots[i].trigger = rows[i][triggerColumn] != 0;
    }
    for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
        knots[i].slope = (knots[i + 1].value - knots[i - 1].value) / (times[i + 1] - times[i - 1]);
    }
    return {std::move(times), std::move(knots), end};
}

RecordedPath::RecordedPath(std::vector<double> times, std::vector<Knot> knots, PathEnd end)
    : times_(std::move(times)), knots_(std::move(knots)), end_(end) {}

// Cubic Hermite in all seven channels. Neighbouring quaternions are close, so that theirs never
// comes near zero and its direction is a smooth rotation.
PathSample RecordedPath::at(double time) const {
    if (end_ == PathEnd::Loop && time > 0 && std::isfinite(time)) {
        time = std::fmod(time, duration());
    }
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const auto next = static_cast<std::size_t>(after - times_.begin());
    Channels value;
    bool trigger = false;
    if (next == 0 || next == times_.size()) {
        const Knot& only = next == 0 ? knots_.front() : knots_.back();
        value = only.value;
        trigger = only.trigger;
    } else {
        const Knot& a = knots_[next - 1];
        const Knot& b = knots_[next];
        const double interval = times_[next] - times_[next - 1];
        const double u = (time - times_[next - 1]) / interval;
        const double v = 1 - u;
        value = v * v * ((1 + 2 * u) * a.value + u * interval * a.slope) +
                u * u * ((1 + 2 * v) * b.value - v * interval * b.slope);
        trigger = a.trigger;
    }
    PathSample sample{{value.head<3>(), Eigen::Quaterniond(value.tail<4>())}, trigger};
    sample.pose.rotation.normalize();
    return sample;
}

}  // namespace cortex::toolkit
