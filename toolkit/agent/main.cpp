// SPDX-License-Identifier: Apache-2.0
// cortex-agent: runs any system file.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/event_sinks.hpp"
#include "cortex/core/service_threads.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/toolkit/classes.hpp"

#include "claims.hpp"
#include "devices.hpp"
#include "give_way.hpp"
#include "hook_check.hpp"
#include "memory_file.hpp"
#include "model_dump.hpp"
#include "options.hpp"
#include "patient_output.hpp"
#include "read_system.hpp"
#include "retained_file.hpp"
#include "start_check.hpp"
#include "start_up.hpp"
#include "stored_values.hpp"
#include "summary.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace cortex::toolkit {
namespace {

enum ExitCode {
    Ended = 0,
    Refused = 1,
    Usage = 2,
    Halted = 3,
    NotFollowed = 4,
    Second = 5,
    HooksBroke = 6
};

// Another start of our name has written its values while this one waited or was away.
struct ValuesAreOld {};

// Retained values outrank those of --settings.
void restoreRetained(const CommandLine& line, SimplexTree& tree, RetainedFile& retained,
                     Claims& claims) {
    if (!RetainedFile::hasItems(tree)) {
        if (!line.retainFile.empty())
            std::cerr << "--retain: no item of this system has retain=\"true\"" << std::endl;
        return;
    }
    claims.takeFile(retainFile(line));
    try {
        std::cout << retained.restore(tree, !line.noDevices) << std::flush;
    } catch (const Error& error) {
        throw UsageError(error.what());
    }
}

using Clock = std::chrono::steady_clock;

// Says when --seconds are over, which count from now or, if there is one, the end of the start-up.
std::function<bool()> countdown(double seconds, const std::optional<StartUp>& startUp) {
    const std::chrono::duration<double> length{seconds};
    auto began = startUp ? std::nullopt : std::optional{Clock::now()};
    return [length, &startUp, began]() mutable {
        if (!began && startUp->isOver()) began = Clock::now();
        return length.count() > 0 && began && Clock::now() - *began >= length;
    };
}

// Until the end is asked for, the loop ends, or `look` says so.
void watch(cs::ClusterCS& cluster, const std::string& name, const std::function<bool()>& look) {
    const bool terminal = isatty(STDOUT_FILENO) != 0;
    auto next = Clock::now();
    cs::waitForInterrupt(0, [&] {
        if (look()) return true;
        if (terminal && Clock::now() >= next) {
            next += std::chrono::seconds{1};
            std::cout << "\r\033[K" << statusLine(cluster.image(), name) << std::flush;
        }
        return !cluster.running();
    });
    if (terminal) std::cout << "\r\033[K" << std::flush;
}

void printStart(const CommandLine& line, const cs::ClusterCS& cluster,
                const ClusterSettings& settings, std::size_t simplexes,
                const std::vector<TalkedTo>& devices) {
    for (const std::string& refused : cluster.realtimeReport()) {
        std::cerr << "real time: " << refused << std::endl;
    }
    std::cout << line.system.string() << ": " << simplexes << " simplexes at "
              << 1e9 / static_cast<double>(settings.period.count()) << " Hz as /" << settings.name
              << (line.offline ? "" : ", domain " + std::to_string(networkOptions(line).domain))
              << std::endl;
    std::cout << devicesLine(devices, !line.noDevices) << std::flush;
}

// Of an interface that is still there.
std::string networkCounts(const comms::DdsInterface* network) {
    if (network == nullptr) return {};
    std::string text = countLine("lost samples", network->lost()) +
                       countLine("refused samples", network->rejected());
    for (const auto& [reason, count] : network->rejections()) {
        text += "    " + std::to_string(count) + ": " + reason + "\n";
    }
    return text;
}

// What the simplexes say before the stop, and what was counted after it: it executes as well.
void printAndStop(cs::ClusterCS& cluster, const std::string& name,
                  const comms::DdsInterface* network) {
    std::string counts;
    {
        const cs::BoundedStep step{"printing the summary"};
        counts = networkCounts(network);
        std::cout << monitorTables(cluster.image()) << faultLines(cluster.image()) << std::flush;
    }
    cluster.stop();
    const cs::BoundedStep step{"printing the metrics"};
    std::cout << metricsTable(cluster.image(), name) << counts << std::flush;
}

// The past of its earlier starts, where a file has it.
std::unique_ptr<MemoryFile> remember(const CommandLine& line, bool retains,
                                     ClusterSettings& settings) {
    using namespace std::chrono;
    const nanoseconds now = system_clock::now().time_since_epoch();
    settings.options.memory = std::make_shared<EventMemory>(line.memoryEntries, now.count());
    const std::filesystem::path file = memoryFile(line, retains);
    if (file.empty()) return nullptr;
    const cs::BoundedStep step{"reading " + file.string()};
    auto memory = std::make_unique<MemoryFile>(file, settings.name, settings.options.memory);
    try {
        std::cout << memory->load() << std::flush;
    } catch (const Error& error) {
        throw UsageError(error.what());
    }
    return memory;
}

// A cluster with what stands beside it.
struct Running {
    const CommandLine& line;
    const ClusterSettings& settings;
    cs::ClusterCS& cluster;
    HookCheck& hookCheck;
    RetainedFile& retained;
    bool retains = false;
    MemoryFile* memory = nullptr;                  // null: the memory has no file
    const comms::DdsInterface* network = nullptr;  // null: offline
    std::optional<StartUp> startUp = {};           // or the next
    std::optional<NotStarted> notStarted = {};

    bool isSecond() const { return network != nullptr && network->isSecond(); }
};

// The interface to the network; null: offline.
const comms::DdsInterface* setUp(cs::ClusterCS& cluster, const CommandLine& line,
                                 const ClusterSettings& settings, HookCheck& hookCheck) {
    setTrigger(cluster, settings);
    hookCheck.watch(cluster);
    cluster.addEventSink(line.log.empty() ? printEvents(std::cerr) : logEvents(line.log),
                         EventLog::Repeats::Folded);
    return line.offline ? nullptr
                        : &cluster.addInterface<comms::DdsInterface>(networkOptions(line));
}

// Another start has ended, which was there meanwhile and left its values.
[[noreturn]] void beginAnew(Running& running) {
    running.retained.giveWay(true);
    running.cluster.stop();
    if (running.memory != nullptr) running.memory->finish();
    throw ValuesAreOld{};
}

// Until its end. False: another start of it is there, to which this one leaves everything.
bool runToEnd(Running& running) {
    const auto isOver = countdown(running.line.seconds, running.startUp);
    GiveWay giveWay{running.cluster, running.settings.name, running.line.startup};
    watch(running.cluster, running.settings.name, [&] {
        const bool isSecond = running.isSecond();
        running.hookCheck.look();
        if (running.memory != nullptr) running.memory->giveWay(isSecond);
        running.retained.giveWay(isSecond);
        if (!running.line.wait && isSecond) return true;
        const auto turn = giveWay.look(isSecond);
        const bool isBack = turn == GiveWay::Turn::OursAgain;
        if (running.retained.isOld() ||
            (isBack && running.retains && running.retained.hasChanged()))
            beginAnew(running);
        const bool isOurs = turn != GiveWay::Turn::Theirs;
        if (!running.startUp) {
            if (isOurs) running.notStarted->look();
        } else {
            if (isBack) running.startUp->again();
            if (isOurs) running.startUp->look();
        }
        return isOver();
    });
    return !giveWay.isAway() && !running.isSecond();
}

int endInOrder(Running& running) {
    cs::ClusterCS& cluster = running.cluster;
    if (running.notStarted) running.notStarted->lookAtEnd();
    const bool endedItself = !cluster.running();  // its trigger has ended, as an event says
    const bool halted = cluster.ended() == cs::Ended::Halted;
    std::string notFollowed = running.startUp ? running.startUp->endText() : "";
    printAndStop(cluster, running.settings.name, running.network);
    for (const std::string& each : cluster.notShutDown()) notFollowed += "shutdown: " + each + "\n";
    running.retained.finish();
    if (running.memory != nullptr) running.memory->finish();
    std::cerr << notFollowed << std::flush;
    const bool broken = running.hookCheck.printEnd();
    if (halted || endedItself || cs::exitWasRefused()) return Halted;
    if (!notFollowed.empty()) return NotFollowed;
    return broken ? HooksBroke : Ended;
}

int runCluster(const CommandLine& line, const ClassRegistry& registry, SimplexTree& tree,
               RetainedFile& retained, HookCheck& hookCheck, Claims& claims) {
    ClusterSettings settings = clusterSettings(tree.description(), line);
    const bool retains = !line.noDevices && RetainedFile::hasItems(tree);
    if (retains) ++settings.options.imageReaders;
    const auto memory = remember(line, retains, settings);
    cs::ClusterCS cluster{settings.name, settings.options};
    cluster.addSimplexTree(tree);
    cluster.useClasses(registry);
    Running running{line, settings, cluster, hookCheck, retained, retains, memory.get()};
    running.network = setUp(cluster, line, settings, hookCheck);
    const std::vector<TalkedTo> devices = devicesOf(tree);
    cluster.beforeFirstCycle([&] {
        claims.takeAll(devices);
        if (retains && retained.hasChanged()) throw ValuesAreOld{};
    });
    const auto finish = [](RetainedFile* each) { each->finish(); };
    const std::unique_ptr<RetainedFile, decltype(finish)> keeping{&retained, finish};
    if (line.startup)
        running.startUp.emplace(cluster, settings.name);
    else
        running.notStarted.emplace(cluster, settings.name, optionsOfTools(line));
    cluster.start();
    if (retains) retained.keep(cluster);
    if (memory) memory->keep();
    printStart(line, cluster, settings, tree.simplexes().size(), devices);
    if (runToEnd(running)) return endInOrder(running);
    std::cerr << "another start of " << settings.name << " is there; this one ends" << std::endl;
    cluster.stop();
    return Second;
}

int runOnce(const CommandLine& line, HookCheck& hookCheck, Claims& claims) {
    ClassRegistry registry;
    addClasses(registry);
    RetainedFile retained{retainFile(line)};
    const OwnedTree tree = readSystem(
        line, registry, [&](SimplexTree& each) { restoreRetained(line, each, retained, claims); });
    try {
        return runCluster(line, registry, *tree, retained, hookCheck, claims);
    } catch (const comms::SecondStart& error) {
        std::cerr
            << error.what()
            << (line.wait
                    ? "\n"
                    : "; end that one, give one of them another name (<cluster name=…>), or wait "
                      "until it has ended (--wait)\n");
        return Second;
    }
}

int run(int argc, char** argv) {
    int exitCode = Ended;
    const auto line = parseCommandLine(argc, argv, exitCode);
    if (!line) return exitCode;
    if (line->dumpsModel) {
        dumpModel(*line);
        return Ended;
    }
    if (line->validates) return printStartFindings(*line) ? Ended : Refused;
    std::optional<PatientOutput> out, errors;
    if (!line->checkHooks) {  // which tells what hooks print with the library's own streams
        out.emplace(std::cout, STDOUT_FILENO);
        errors.emplace(std::cerr, STDERR_FILENO);
    }
    HookCheck hookCheck{line->checkHooks, argv};
    cs::blockStopSignals();
    Claims claims{*line};
    for (;;) {
        try {
            return runOnce(*line, hookCheck, claims);
        } catch (const ValuesAreOld&) {
            std::cout << retainFile(*line).string()
                      << " was written by another start meanwhile: it is read again" << std::endl;
        }
    }
}

}  // namespace
}  // namespace cortex::toolkit

int main(int argc, char** argv) {
    using namespace cortex;
    try {
        return toolkit::run(argc, argv);
    } catch (const ModelError& error) {
        std::cerr << error.report().text();
        return toolkit::Refused;
    } catch (const toolkit::Taken& error) {
        std::cerr << error.what() << '\n';
        return toolkit::Second;
    } catch (const toolkit::UsageError& error) {
        std::cerr << error.what() << '\n';
        return toolkit::Usage;
    } catch (const std::system_error& error) {
        const std::string refused = threadRefused(error);
        std::cerr << (refused.empty() ? error.what() : refused) << '\n';
        return toolkit::Refused;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return toolkit::Refused;
    } catch (...) {
        std::cerr << "ended, as a plug-in threw what is no std::exception\n";
        return toolkit::Refused;
    }
}
