// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/findings_json.hpp"

#include "text/plain_text.hpp"

#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace cortex::cli {

enum class Stream { Output, Errors };
bool coloured(Stream stream);  // on a terminal only, and not where NO_COLOR says no

using Json = nlohmann::ordered_json;  // keys in the order in which they are added

// What the program ends with: docs/command-line.md.
enum Exit : int { Yes = 0, No = 1, Usage = 2, NotFound = 3, StillRunning = 4 };

// A verb that cannot do what it was asked; main() prints it as text or as schemas/error.json.
class Failure : public std::runtime_error {
public:
    Failure(Exit code, const std::string& message, Report report = {})
        : std::runtime_error{message}, code_{code}, report_{std::move(report)} {}

    Exit code() const { return code_; }
    const Report& report() const { return report_; }

private:
    Exit code_;
    Report report_;
};

// A file that is there, or a name as files of models have it; no type's name has a dot.
bool looksLikeFile(const std::string& argument);

// Lines of cells in aligned columns; cells beyond the last column of text are not padded.
class Columns {
public:
    explicit Columns(std::size_t indent) : indent_{indent} {}

    void add(std::vector<std::string> cells) { lines_.push_back({std::move(cells), false}); }
    void addNote(std::string text) { lines_.push_back({{std::move(text)}, true}); }
    void print(std::ostream& stream) const;

private:
    struct Line {
        std::vector<std::string> cells;
        bool note;  // stands under its line, across all columns
    };

    std::size_t indent_;
    std::vector<Line> lines_;
};

void print(const Json& json);  // to standard output

inline Json findingsJson(const Report& report) { return cortex::findingsJson<Json>(report); }
void printFindings(const Report& report, Stream stream);  // one a line; coloured on a terminal

}  // namespace cortex::cli
