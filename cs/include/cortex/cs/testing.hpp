// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/validation.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::cs {

// A few simplexes, or the system of a file, on a manual trigger: for tests of a plug-in or a class.
// Nothing runs unless it is stepped, so a test waits for nothing. Concepts without a writer are
// written by the test between cycles, by tree().at(path).data<double>(item). Setup, until start():
// functions throw Error and ModelError.
class TestPlant {
public:
    using Pairs = std::vector<std::pair<std::string, std::string>>;
    using Arguments = ProgramInterface::Arguments;

    // Ontologies, morphologies and at most one system file. `name`: of the agent; "": that of the
    // file's cluster, or "plant".
    explicit TestPlant(const std::vector<std::filesystem::path>& files,
                       std::chrono::nanoseconds period = std::chrono::milliseconds{1},
                       const std::string& name = {});
    ~TestPlant();
    TestPlant(const TestPlant&) = delete;
    TestPlant& operator=(const TestPlant&) = delete;

    void loadPlugin(const std::filesystem::path& file);
    ClassRegistry& classes();  // for classes of the test's own program
    // As in a system file: rule and path for each relationship, item and text for each setting.
    void add(const std::string& path, const std::string& type, const Pairs& relates = {},
             const Pairs& settings = {});
    void add(SystemDescription::SimplexEntry simplex);  // with all that a file can say of it
    void start();                                       // and one cycle

    void step(std::int64_t cycles = 1);
    void standStill(std::int64_t periods);  // one cycle, after which so many ticks are missed
    CallResult call(std::string_view path, std::string_view command,
                    const Arguments& arguments = {});  // steps until the answer is there
    void startUp();  // all simplexes; throws Error naming who did not follow

    template <class T>
    T get(std::string_view path, std::string_view item) {
        return cluster().image().get<T>(path, item);
    }
    State state(std::string_view path);
    std::int64_t cycle();  // the last one
    SimplexTree& tree();
    ClusterCS& cluster();

    // What one cycle leaves to the next in tables and in what keep() keeps. The framework's own
    // part is not in it: states, commands on their way, long commands, leases.
    struct Saved {
        std::vector<std::byte> tables;
        std::map<std::string, std::vector<std::byte>> kept;  // by path; of active simplexes
        bool operator==(const Saved&) const = default;
    };
    Saved save();
    // Into a plant that was made alike. What is taken out of `kept` before stays as it is.
    void restore(const Saved& saved);

    // Each item that is neither constant nor measured, as "/path.item", with its exact text; but
    // for the metrics of the cluster.
    using Values = std::map<std::string, std::string>;
    Values values();
    // A line for each that differs: "/tank.level is 1 and 1.5"; "": none.
    static std::string differences(const Values& one, const Values& other);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

// What the tests of CorteX itself need of a loop.
struct TestOptions {
    bool forceThreads = false;    // all that are asked for, also more than there are CPUs
    std::uint32_t chunkSize = 0;  // tasks in a chunk; 0: the schedule decides
    // Runs on each of the loop's threads (0: the loop's own) before its first cycle.
    std::function<void(std::uint32_t thread)> onThreadStart{};
    // After which stop() ends the process, where no cycle comes or ends meanwhile.
    std::chrono::milliseconds endBudget{1500};
    Extent extent = Extent::Whole;  // of the system: in a part nobody need write what it reads
};

struct ClusterTesting {
    static void set(ClusterCS& cluster, TestOptions options);  // before start()
    static void judgeAsPart(ClusterCS& cluster);               // after set()
    // Beside that of the options, after set().
    static void onThreadStart(ClusterCS& cluster, std::function<void()> function);
    // What this thread runs now, where it is one of a loop; all empty: no hook. The texts stay as
    // long as the cluster.
    struct RunningHook {
        std::string_view path, type, hook;
    };
    static RunningHook runningHook() noexcept;
    // From its next cycle on the loop runs the same tasks on so many threads, with so many tasks in
    // a chunk. False: it has not given the plan before back yet. While the loop waits for its tick.
    static bool offerPlan(ClusterCS& cluster, std::uint32_t threads, std::uint32_t chunkSize);
    // Plays an overload: the tick after the next counts so many missed periods.
    static void playLate(ManualTrigger& trigger, std::int64_t periods);

private:
    static TestOptions& optionsOf(ClusterCS& cluster);
};

}  // namespace cortex::cs
