// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace cortex::toolkit {

// Writes to a file of the process for a stream of the library, as long as it lives, and holds up
// nobody for long. Where nobody reads (a full pipe, a terminal after Ctrl-S), what does not fit
// within 0.2 s is left out; who reads again is told how many lines. Any thread.
class PatientOutput final : public std::streambuf {
public:
    PatientOutput(std::ostream& stream, int file);
    ~PatientOutput() override;

protected:
    int sync() override;
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;

private:
    void send();
    bool write(std::string_view text);  // false: a part of it is left out

    std::ostream& stream_;
    std::streambuf* const before_;
    const int file_, quick_;  // a write to `quick_` never waits; it is `file_` where there is none
    std::mutex mutex_;
    std::string kept_;         // until the next flush
    std::size_t missing_ = 0;  // lines
    bool isStuck_ = false;
};

}  // namespace cortex::toolkit
