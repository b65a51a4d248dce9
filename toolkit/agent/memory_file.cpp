// SPDX-License-Identifier: Apache-2.0
#include "memory_file.hpp"

#include "cortex/core/error.hpp"

#include "memory_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <iostream>
#include <limits>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t pageSize = std::size_t{256} << 10U, slack = std::size_t{64} << 10U;
constexpr int quietRefusals = 5;  // who had the file may still be about to end
constexpr int flagsOfAll = O_NOFOLLOW | O_NONBLOCK, flagsToWrite = O_RDWR | O_APPEND | flagsOfAll;

std::string failedAt(const fs::path& file) { return file.string() + ": " + std::strerror(errno); }

std::string secondText(std::int64_t wallClock) {
    const std::time_t time = wallClock / 1'000'000'000;
    std::tm parts{};
    gmtime_r(&time, &parts);
    std::array<char, 40> text{};
    std::strftime(text.data(), text.size(), "%FT%TZ", &parts);
    return text.data();
}

bool isFileAt(const OpenFile& file, const fs::path& path, struct stat& there) {
    struct stat here{};
    return fstat(file.number(), &here) == 0 && lstat(path.c_str(), &there) == 0 &&
           S_ISREG(there.st_mode) && here.st_ino == there.st_ino && here.st_dev == there.st_dev;
}

// False: another process has it. Where the file system has no locks, everybody gets it.
bool lock(const OpenFile& file) {
    return flock(file.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace

MemoryFile::MemoryFile(fs::path file, std::string agent, std::shared_ptr<EventMemory> memory)
    : path_{std::move(file)},
      agent_{std::move(agent)},
      memory_{std::move(memory)},
      begin_{memory_->since()},
      trouble_{"what the agent remembers is", path_} {}

MemoryFile::~MemoryFile() { finish(); }

std::string MemoryFile::load() {
    if (const std::string wrong = wrongFile(); !wrong.empty()) throw Error("--memory: " + wrong);
    std::error_code none;
    if (!fs::exists(path_, none))  // it is made after the start, which may be refused
        return path_.string() + ": keeps what happens from now on over restarts\n";
    const std::string problem = take(true);
    if (!isRead_ || !problem.empty()) return {};  // the thread tries again, and tells why
    const auto since = memory_->since();
    return path_.string() + ": all that happened since " +
           secondText(*std::ranges::max_element(since)) + " is remembered\n";
}

void MemoryFile::keep() {
    static constexpr Repeating::Pause interval{200}, afterTrouble{1000};
    writing_.start("cortex-memory", {}, [this] { return step() ? interval : afterTrouble; });
}

void MemoryFile::finish() {
    if (!writing_.finish()) return;
    synced_ = {};
    const bool isWritten = step();
    if (!file_)
        leaveToOther();
    else if (isWritten)
        markEnd();
}

// Another start has the file, which may stand still. Whatever is added to it that one finds by its
// size, and takes in.
void MemoryFile::leaveToOther() {
    constexpr int tries = 5;  // that one may replace it at any time
    struct stat there{};
    for (int i = 0; i < tries && wrongFile().empty(); ++i) {
        const OpenFile file{path_, flagsToWrite};
        End end{end_.place, 0, begin_};
        bool good = static_cast<bool>(file);
        for (bool more = true; good && more;) good = writePage(file, end, more);
        if (!good || (end.size > 0 && !file.writeAll(endLine())))
            return trouble_.tell(failedAt(path_));
        if (isFileAt(file, path_, there)) return;
    }
    trouble_.tell("another start of the agent has " + path_.string());
}

// What follows is of another start.
void MemoryFile::markEnd() {
    if (file_.writeAll(endLine())) end_.size += endLine().size();
}

bool MemoryFile::step() {
    if (away_ && !file_) return true;
    const std::string problem = write();
    const bool isKept = static_cast<bool>(file_);
    if (isKept || !problem.empty()) trouble_.tell(problem);
    if (away_ && isKept) {
        if (problem.empty()) markEnd();
        file_.close();
    }
    return isKept && problem.empty();
}

std::string MemoryFile::write() {
    if (file_ && !isIntact()) file_.close();
    if (!file_) {
        const std::string problem = take(false);
        if (!file_) return problem;
    }
    if (anew_) return writeAnew();
    std::string problem = append();
    if (!problem.empty()) return problem;
    return isTooLarge(end_) ? writeAnew() : sync();
}

// It may have been deleted or replaced, or somebody wrote to it.
bool MemoryFile::isIntact() const {
    struct stat there{};
    return isFileAt(file_, path_, there) && static_cast<std::size_t>(there.st_size) == end_.size;
}

bool MemoryFile::isTooLarge(const End& end) const {
    return end.size > 2 * std::max(memory_->bytes(), sizeAnew_) + slack;
}

std::string MemoryFile::wrongFile() const {
    if (std::string other = otherThanAFile(path_); !other.empty()) return other;
    const OpenFile file{path_, O_RDONLY | flagsOfAll};
    struct stat there{};
    if (!file || !isFileAt(file, path_, there) || there.st_size == 0) return "";
    return otherThanMemory(path_, firstLineOf(file), agent_);
}

std::string MemoryFile::take(bool beforeStart) {
    if (std::string wrong = wrongFile(); !wrong.empty()) return wrong;
    if (std::string missing = missingFolder(path_); !missing.empty()) return missing;
    OpenFile file{path_, flagsToWrite | O_CREAT};
    const bool isWritable = static_cast<bool>(file);
    if (!file && beforeStart) file = OpenFile{path_, O_RDONLY | flagsOfAll};
    if (!file) return failedAt(path_);
    struct stat there{};
    if (!lock(file) || !isFileAt(file, path_, there)) {  // or it was replaced just now
        if (++refused_ < quietRefusals) return "";
        return path_.string() +
               " is another agent's that runs: end that one, or name another file with --memory";
    }
    refused_ = 0;
    read(file, beforeStart);
    if (isWritable) file_ = std::move(file);
    return "";
}

// What is already known is left out: a file that comes back has entries of before.
void MemoryFile::read(const OpenFile& file, bool beforeStart) {
    std::set<std::int64_t> found;
    const EventMemory::Times own = memory_->since();
    const auto take = [&](KeptEvent event) {
        if (known_.contains(event.epoch)) return;
        found.insert(event.epoch);
        if (const auto place = memory_->recall(std::move(event)); place != 0) end_.place = place;
    };
    struct stat there{};
    const bool isKnown = fstat(file.number(), &there) == 0;
    const MemoryRead read = readMemory(file, *std::ranges::max_element(own), take);
    const bool crashed = isKnown && read.epoch != 0 && !read.ended && found.contains(read.epoch);
    known_.merge(found);
    EventMemory::Times since = own;
    for (std::size_t i = 0; i < since.size(); ++i) {
        if (read.since[i] == MemoryRead::unsaid) continue;
        since[i] = isRead_ ? std::max(own[i], read.since[i]) : read.since[i];
    }
    memory_->goOn(since);
    tellDropped(file, since);
    if (crashed)
        tellCrash(read.epoch, there.st_mtim.tv_sec * 1'000'000'000 + there.st_mtim.tv_nsec);
    isRead_ = true;
    end_.size = read.bytes;
    end_.since = read.since;
    anew_ = !beforeStart || read.bytes == 0 || read.torn || read.unreadable > 0 || crashed;
    if (read.unreadable == 0) return;
    std::cerr << path_.string() << ": " << read.unreadable
              << (read.unreadable == 1 ? " line that cannot be read is"
                                       : " lines that cannot be read are")
              << " left out" << std::endl;
}

// What the earlier start had kept since then, and this one has no room for.
void MemoryFile::tellDropped(const OpenFile& file, const EventMemory::Times& before) const {
    const EventMemory::Times now = memory_->since();
    if (now == before || lseek(file.number(), 0, SEEK_SET) != 0) return;
    std::ptrdiff_t dropped = 0;
    const auto isConcerned = [&](const KeptEvent& event) {
        const auto kind = static_cast<std::size_t>(
            std::ranges::find(EventMemory::kinds, event.kind) - EventMemory::kinds.begin());
        return kind < now.size() && event.wallClock >= before[kind] && event.wallClock < now[kind];
    };
    readMemory(file, 0, [&](const KeptEvent& event) { dropped += isConcerned(event) ? 1 : 0; });
    const auto kept = memory_->page(0, std::numeric_limits<std::int64_t>::min());
    dropped -= std::ranges::count_if(kept.events, isConcerned);
    if (dropped <= 0) return;
    std::cerr << path_.string() << ": the oldest entries are dropped, " << dropped
              << " in all, as they are more than the agent keeps (--memory-entries)" << std::endl;
}

// What that start kept last may not have come to the file, so nothing is not peace.
void MemoryFile::tellCrash(std::int64_t epoch, std::int64_t written) {
    KeptEvent event;
    event.epoch = epoch;
    event.wallClock = written;
    event.severity = Severity::Warning;
    event.kind = EventKind::Loss;
    event.path = "/" + agent_;
    event.text = "ended without a word: what happened from here to its next start may be missing";
    if (const auto place = memory_->recall(std::move(event)); place != 0) end_.place = place;
    std::cout << path_.string() << ": the agent ended without a word; what happened after "
              << secondText(written) << " until then may be missing" << std::endl;
}

std::string MemoryFile::append() {
    bool more = true;
    while (more && !isTooLarge(end_)) {
        if (writePage(file_, end_, more)) continue;
        std::string problem = failedAt(path_);
        if (ftruncate(file_.number(), static_cast<off_t>(end_.size)) != 0) file_.close();
        return problem;
    }
    return "";
}

// What was dropped before it could be written is told before what came after it.
bool MemoryFile::writePage(const OpenFile& file, End& end, bool& more) {
    const EventMemory::Page page = memory_->page(
        end.place, std::numeric_limits<std::int64_t>::min(), EventMemory::always, pageSize);
    const EventMemory::Times since = memory_->since();
    std::string text;
    for (std::size_t i = 0; i < since.size(); ++i) {
        if (since[i] != end.since[i]) text += sinceLine(EventMemory::kinds[i], since[i]);
    }
    for (const KeptEvent& each : page.events) text += lineOf(each);
    if (!file.writeAll(text)) return false;
    if (!text.empty()) isSynced_ = false;
    end.size += text.size();
    end.since = since;
    for (const KeptEvent& each : page.events) known_.insert(each.epoch);
    if (!page.events.empty()) end.place = page.events.back().place;
    more = page.more;
    return true;
}

std::string MemoryFile::writeAnew() {
    const fs::path next = path_.string() + ".new";
    OpenFile file{next, flagsToWrite | O_CREAT | O_TRUNC};
    if (!file) return failedAt(next);
    const std::string header = memoryHeader(agent_);
    End end{0, header.size(), {}};
    end.since.fill(MemoryRead::unsaid);
    bool good = lock(file) && file.writeAll(header);
    for (bool more = true; good && more;) good = writePage(file, end, more);
    good = good && file.sync();
    std::string problem = good ? putInPlace(next, path_) : failedAt(next);
    if (!problem.empty()) {
        std::error_code none;
        fs::remove(next, none);
        return problem;
    }
    file_ = std::move(file);
    end_ = end;
    sizeAnew_ = end.size;
    anew_ = false;
    isSynced_ = true;
    return "";
}

// Once a second at most.
std::string MemoryFile::sync() {
    constexpr std::chrono::seconds pauseOfSync{1};
    if (isSynced_ || Clock::now() - synced_ < pauseOfSync) return "";
    synced_ = Clock::now();
    isSynced_ = file_.sync();
    return isSynced_ ? "" : failedAt(path_);
}

}  // namespace cortex::toolkit
