// SPDX-License-Identifier: Apache-2.0
#include "report/results_files.hpp"

#include "cortex/core/error.hpp"

#include "report/html_report.hpp"
#include "report/number_text.hpp"
#include "report/pictures.hpp"
#include "report/quantity_text.hpp"
#include "report/results_json.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>

namespace cortex::profiler {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannotWrite(const fs::path& file, const std::string& why) {
    throw Error{"cannot write '" + file.string() + "': " + why +
                "; make room or name another folder"};
}

void write(const fs::path& file, const std::string& text) {
    const fs::path part = file.parent_path() / ("." + file.filename().string() + ".part");
    errno = 0;
    std::ofstream stream{part, std::ios::binary | std::ios::trunc};
    stream << text;
    stream.close();
    if (!stream) cannotWrite(file, std::strerror(errno));
    std::error_code error;
    fs::rename(part, file, error);
    if (error) cannotWrite(file, error.message());
}

std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string{"\"\""} : std::string{c};
    return result + "\"";
}

std::string row(const std::vector<std::string>& cells) {
    std::string result;
    for (const std::string& each : cells) result += cell(each) + ",";
    result.back() = '\n';
    return result;
}

std::string heading(const Axis& axis, const char* otherwise) {
    const std::string label = axis.label.empty() ? otherwise : axis.label;
    return axis.unit.empty() ? label : label + " (" + axis.unit + ")";
}

std::string fileName(std::string id) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_' || c == '.';
    };
    std::ranges::replace_if(id, std::not_fn(allowed), '-');
    if (id.size() > 100) id.resize(100);
    if (id.empty() || id.front() == '.') id.insert(0, "figure");
    return id;
}

// As it stands within a page; empty where it was not drawn.
std::string picture(const fs::path& file) {
    std::ifstream stream{file, std::ios::binary};
    const std::string text{std::istreambuf_iterator<char>{stream}, {}};
    const std::size_t begin = text.find("<svg");
    return begin == std::string::npos ? "" : text.substr(begin);
}

}  // namespace

std::vector<std::string> figureFiles(const Results& results) {
    std::vector<std::string> names{"summary"};  // a file of its own
    for (const Figure& each : results.figures) {
        const std::string wished = fileName(each.id);
        std::string name = wished;
        for (int i = 2; std::ranges::find(names, name) != names.end(); ++i) {
            name = wished + "-" + std::to_string(i);
        }
        names.push_back(name);
    }
    names.erase(names.begin());
    return names;
}

std::string figureCsv(const Figure& figure) {
    std::string text = row({"series", heading(figure.x, "x"), heading(figure.y, "y")});
    for (const Series& series : figure.series) {
        const std::string name = cell(series.name) + ",";
        for (const Point& point : series.points) {
            text += name + exact(point.x) + "," + exact(point.y) + "\n";
        }
    }
    return text;
}

std::string summaryCsv(const Results& results) {
    std::string text = row({"id", "what", "unit", "value", "repeats", "baseline", "baseline name",
                            "ratio", "aim", "limit", "verdict", "paper"});
    for (const Quantity& each : results.quantities) {
        const std::optional<double> ratio = ratioToBaseline(each);
        const std::string verdict = verdictText(each);
        const std::string aim = each.aim == Aim::AtMost ? "at most" : "at least";
        text += row({each.id, each.what, each.unit, exact(each.value),
                     std::to_string(each.repeats.size()), exact(each.baseline), each.baselineName,
                     ratio ? exact(*ratio) : "", verdict.empty() ? "" : aim,
                     verdict.empty() ? "" : exact(each.limit), verdict, each.paper});
    }
    return text;
}

void save(const Results& results, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) cannotWrite(folder, error.message());
    write(folder / "results.json", jsonText(results));
    write(folder / "summary.csv", summaryCsv(results));
    const std::vector<std::string> names = figureFiles(results);
    for (std::size_t i = 0; i < names.size(); ++i) {
        write(folder / (names[i] + ".csv"), figureCsv(results.figures[i]));
    }
    Results shown = results;
    const std::string trouble = drawPictures(results.figures, names, folder);
    if (!trouble.empty()) shown.notes.insert(shown.notes.begin(), trouble);
    std::vector<std::string> pictures;
    for (const std::string& name : names) pictures.push_back(picture(folder / (name + ".svg")));
    write(folder / "report.html", htmlReport(shown, pictures));
}

Results load(const fs::path& folder) {
    const fs::path file = folder / "results.json";
    const std::string remedy = "; name the folder that 'cortex-profiler run' wrote, or run again";
    std::error_code ignored;
    std::ifstream stream{file, std::ios::binary};
    if (!stream.is_open() || !fs::is_regular_file(file, ignored)) {
        throw Error{"cannot read '" + file.string() + "': a file with results is expected" +
                    remedy};
    }
    const std::string text{std::istreambuf_iterator<char>{stream}, {}};
    try {
        return resultsOf(text);
    } catch (const Error& error) {
        throw Error{"'" + file.string() + "': " + error.what() + remedy};
    }
}

}  // namespace cortex::profiler
