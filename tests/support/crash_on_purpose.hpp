// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <map>
#include <string>

namespace cortex::test {

// While it lives, no sanitizer reports the crashes of processes that are started; they end by their
// signal.
class CrashOnPurpose {
public:
    CrashOnPurpose() {
        for (auto& [name, before] : before_) {
            const char* const given = std::getenv(name.c_str());
            before = given ? given : "";
            const std::string options = before + ":handle_segv=0:handle_sigfpe=0:handle_abort=0";
            setenv(name.c_str(), options.c_str(), 1);
        }
    }
    ~CrashOnPurpose() {
        for (const auto& [name, before] : before_) setenv(name.c_str(), before.c_str(), 1);
    }
    CrashOnPurpose(const CrashOnPurpose&) = delete;
    CrashOnPurpose& operator=(const CrashOnPurpose&) = delete;

private:
    std::map<std::string, std::string> before_{{"ASAN_OPTIONS", ""}, {"TSAN_OPTIONS", ""}};
};

}  // namespace cortex::test
