// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_sinks.hpp"

#include "cortex/core/error.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <system_error>

namespace cortex {

namespace {

void writeLine(std::ostream& out, const Event& event, const Structure& structure) {
    out << lineOf(event, structure, event.wallClock) << '\n' << std::flush;
}

}  // namespace

EventLog::Sink printEvents(std::ostream& out) {
    return [&out](const Event& event, const Structure& structure) {
        writeLine(out, event, structure);
    };
}

EventLog::Sink logEvents(const std::filesystem::path& file) {
    std::error_code ignored;
    const auto status = std::filesystem::status(file, ignored);
    if (std::filesystem::is_fifo(status) || std::filesystem::is_socket(status)) {
        throw Error("the log file " + file.string() +
                    " is a pipe, whose reader could hold up all events: give a regular file, or "
                    "leave --log out, and they go to the standard error");
    }
    auto out = std::make_shared<std::ofstream>(file, std::ios::app);
    if (!*out) throw Error("cannot write the log file " + file.string() + ": give another --log");
    return [out, file, lost = 0](const Event& event, const Structure& structure) mutable {
        if (!*out) *out = std::ofstream{file, std::ios::app};  // the disk may have room again
        if (lost > 0) *out << "(events missing here: " << lost << ")\n";
        writeLine(*out, event, structure);
        if (*out) {
            lost = 0;
        } else if (++lost == 1) {
            std::cerr << "cannot write the log file " << file.string()
                      << ": events are lost until it can be written again\n";
        }
    };
}

}  // namespace cortex
