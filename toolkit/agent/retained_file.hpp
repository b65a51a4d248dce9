// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "durable_file.hpp"
#include "repeating.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace cortex::toolkit {

// Keeps the items with retain="true" in a file, so that they survive a restart. restore() before
// start(), keep() after it, finish() after stop(): the program's thread. A thread of its own reads
// images and writes once a second at most; the loop knows nothing of it.
class RetainedFile {
public:
    explicit RetainedFile(const std::filesystem::path& file)
        : file_{file}, trouble_{"retained items are", file} {}
    ~RetainedFile() { finish(); }
    RetainedFile(const RetainedFile&) = delete;
    RetainedFile& operator=(const RetainedFile&) = delete;

    static bool hasItems(const SimplexTree& tree);

    // Makes what the file holds start values, and returns the lines that tell it. What is good of a
    // file with anything wrong in it counts all the same; where this agent keeps values, it is set
    // aside as FILE.broken. Throws Error where there is something that is no regular file, or a
    // model.
    std::string restore(SimplexTree& tree, bool keeps);
    // Another process has written it since this one read or wrote it.
    bool hasChanged() const;
    // Another start has written it while this process stood still. What this one has is older, and
    // is not written: begin anew.
    bool isOld() const { return isOld_; }
    void keep(cs::ClusterCS& cluster);
    void finish();  // the last values, of the last cycle
    // Another start of the agent is there: the file is that one's meanwhile.
    void giveWay(bool away) { away_ = away; }

private:
    enum class Last : std::uint8_t { No, Yes };
    void write(Last last);
    std::string textOf(const Image& image);

    std::filesystem::path file_;
    cs::ClusterCS* cluster_ = nullptr;
    std::map<std::string, std::string> good_;  // path.item: the last value that may be restored
    std::atomic<bool> away_ = false, isOld_ = false;
    mutable std::mutex mutex_;  // guards the rest but for the last two
    std::string known_;         // the file's text, as this process read or wrote it last
    std::chrono::steady_clock::time_point looked_{};
    bool isDoubtful_ = false;  // there was a standstill
    WriteTrouble trouble_;
    Repeating writing_;
};

}  // namespace cortex::toolkit
