// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/made_agent.hpp"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace cortex::test {

// A random system whose names are as the rules ask, and whose texts are what a hostile agent would
// say: markup, control characters, marks of direction, very long lines, placeholders.
class HostileModel {
public:
    explicit HostileModel(unsigned seed);

    std::shared_ptr<gui::Frame> frame();  // with other values, qualities and words each time
    std::vector<comms::AgentEvent> events(std::size_t count);
    const std::vector<std::string>& paths() const { return paths_; }  // of simplexes
    std::string text();

private:
    bool often(int percent) { return number(1, 100) <= percent; }
    int number(int least, int most) {
        return std::uniform_int_distribution<int>{least, most}(random_);
    }
    std::string label();
    DataItem item(const std::string& name, bool safe);
    TypeModel types();
    void fill(SimplexTree& tree);
    void setValues();
    std::string path(const std::string& name);

    std::mt19937 random_;
    std::vector<std::string> concepts_, processors_, paths_;
    std::uint64_t lastEvent_ = 0;
    std::unique_ptr<MadeAgent> agent_;
};

}  // namespace cortex::test
