// SPDX-License-Identifier: Apache-2.0
#include "claims.hpp"

#include "cortex/cs/cluster_cs.hpp"

#include <chrono>
#include <iostream>

#include <sys/stat.h>

namespace cortex::toolkit {
namespace {

constexpr const char* orTry = "try this system with --no-devices, which has no device and no file";

// The folder by its number, so that a file has one name whatever leads to it.
std::string keyOf(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    struct stat there{};
    if (stat(folder.c_str(), &there) != 0)
        return "file " + std::filesystem::absolute(file).lexically_normal().string();
    return "file " + std::to_string(there.st_dev) + ":" + std::to_string(there.st_ino) + "/" +
           file.filename().string();
}

}  // namespace

void Claims::takeFile(const std::filesystem::path& retained) {
    if (line_.noDevices) return;
    file_ = {keyOf(retained), "the retained values in " + retained.string(),
             "name another file (--retain)"};
    if (line_.wait && !line_.offline)
        claims_.take(file_->key);
    else
        take(*file_);
}

void Claims::takeAll(const std::vector<TalkedTo>& devices) {
    if (line_.noDevices) return;
    if (!patience_) patience_ = std::chrono::steady_clock::now() + std::chrono::seconds{1};
    if (file_) take(*file_);
    for (const TalkedTo& each : devices)
        take(
            {"device " + each.name, each.path + " at " + each.name, "leave " + each.path + " out"});
}

// Who ends in order writes its last values after it has left the network.
bool Claims::comesFree(const Thing& thing) {
    const auto isFree = [&] { return claims_.take(thing.key).empty(); };
    const std::chrono::duration<double> left = *patience_ - std::chrono::steady_clock::now();
    if (left.count() > 0 && cs::waitForInterrupt(left.count(), isFree))
        throw Taken("this one was stopped before it began");
    return isFree();
}

void Claims::take(const Thing& thing) {
    const std::string holder = claims_.take(thing.key);
    if (holder.empty()) return;
    const std::string what = thing.text + ": " + holder + " has it";
    const std::string remedies = "; end that one, " + thing.remedy + ", or " + orTry;
    if (!line_.wait) throw Taken(what + remedies);
    if (!line_.offline) {
        if (comesFree(thing)) return;
        std::cerr << what << ", and stands still or is silent: this one goes on" << std::endl;
        return;
    }
    std::cerr << what << "; this one waits until it has ended" << std::endl;
    const bool isStopped = cs::waitForInterrupt(0, [&] { return claims_.take(thing.key).empty(); });
    if (isStopped) throw Taken(what + remedies);
}

}  // namespace cortex::toolkit
