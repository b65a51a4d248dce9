// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/security.hpp"

#include "core/model_folder.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace cortex::comms {

// An authority and the folders that it made, for the time of a test.
class SecuredPlant {
public:
    SecuredPlant() { createAuthority(authority()); }

    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::filesystem::path authority() const { return path("authority"); }
    // The folder of a new agent that may command all that is at and below these paths.
    std::string make(const std::string& agent, std::vector<std::string> mayCommand = {"/"},
                     std::vector<int> domains = {}) const {
        createAgent(authority(), path(agent),
                    {agent, std::move(mayCommand), std::move(domains), {}});
        return path(agent).string();
    }

private:
    test::ModelFolder folder_;
};

// The first `from` in a file becomes `to`.
inline void tamper(const std::filesystem::path& file, const std::string& from,
                   const std::string& to) {
    std::string text = test::textOf(file);
    text.replace(text.find(from), from.size(), to);
    std::ofstream{file} << text;
}

}  // namespace cortex::comms
