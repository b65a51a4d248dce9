// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "record/recorder.hpp"
#include "session/frame.hpp"
#include "session/holds.hpp"
#include "session/lease_keeper.hpp"
#include "session/lost_agents.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cortex::gui {

// What became of a command that was sent.
struct CommandOutcome {
    std::uint64_t number = 0;  // that Session::send() gave
    std::string path, command;
    comms::CommandAnswer answer;
    std::string problem;  // why it was never sent; otherwise empty
    std::int64_t came{};  // UTC ns, when the window took it; 0: not yet
};

// One domain, looked at by a thread of its own: it alone joins, asks and leaves, so that nothing
// the network does can hold up the screen. Called by the GUI thread; no call waits.
class Session {
public:
    explicit Session(comms::NetworkOptions options);
    ~Session();  // leaves the domain
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const comms::NetworkOptions& options() const { return options_; }
    // The newest moment; never null. Its ages grow also while no newer one comes.
    std::shared_ptr<const Frame> frame() const;
    // From now on the values of all simplexes at and below these paths, at the rate that the user
    // has set, and of others at rates of their own.
    void view(std::vector<std::string> prefixes, std::vector<comms::Viewed> others = {});
    // How often values are taken, in Hz: one of `rates`; 0: in every cycle of their agent.
    static constexpr std::array<std::uint32_t, 4> rates{5, 30, 100, 0};
    void setRate(std::uint32_t rate);
    // What plots show of the past. Values that it records are taken in every cycle.
    Recorder& recorder() { return recorder_; }
    // The events that came since the last call, the last 1,000 of each agent first.
    std::vector<comms::AgentEvent> takeEvents();
    void joinAgain();  // after it could not join
    // A lost agent stays in all frames until a person dismisses it, or it is heard again.
    void dismiss(std::string agent);
    // Sends a command at once, and gives its number. It expires if its agent has not read it within
    // the budget. Whoever has not answered within the limit, or is not heard any longer, is
    // Unknown.
    std::uint64_t send(std::string path, std::string command,
                       comms::Mirror::Arguments arguments = {},
                       std::chrono::milliseconds limit = std::chrono::seconds{30},
                       std::chrono::milliseconds budget = std::chrono::seconds{5});
    // The outcomes that came since the last call, each once.
    std::vector<CommandOutcome> takeOutcomes();

    // Repeats a command until endHold(), or until it ends by itself: control or the agent is lost,
    // an answer is no success or takes longer than the budget, or isAlive() is not called for
    // 0.25 s. Gives its number.
    std::uint64_t hold(HeldCommand command);
    void changeHold(std::uint64_t number, comms::Mirror::Arguments arguments);
    void endHold(std::uint64_t number);
    std::vector<HoldEnd> takeHoldEnds();  // that ended by themselves since the last call

    // Control of everything at and below a path, or of nothing. Frame::control tells what came of
    // it. It is renewed only while isAlive() is called at least once a second.
    void takeControl(std::string prefix);
    void releaseControl();
    void handOver(std::string to);  // what is held first
    void isAlive();

private:
    void run();
    void join();
    void publish();
    void sendRequests();
    void takeAnswers();
    void keepControl();
    void keepHolds();
    void applyView(std::vector<std::string> wanted, std::vector<comms::Viewed> views,
                   std::uint32_t rate);
    void keepLost(std::vector<AgentFrame>& agents);
    bool pause();  // until the next frame is due; false: the session ends

    comms::NetworkOptions options_;
    Recorder recorder_;
    std::unique_ptr<comms::Mirror> mirror_;  // thread_ alone, once it runs
    std::unique_ptr<LeaseKeeper> leases_;    // ends before the mirror; thread_ alone
    std::unique_ptr<Holds> holds_;           // the same
    std::vector<comms::Viewed> applied_;     // the views that the mirror has; thread_ alone
    std::uint32_t appliedRate_ = 0;          // the same
    LostAgents lost_;                        // thread_ alone
    std::uint64_t number_ = 0, structures_ = 0;
    std::chrono::steady_clock::time_point begin_;
    std::string problem_;

    struct Request {
        std::uint64_t number = 0;
        std::string path, command;
        comms::Mirror::Arguments arguments;
        std::chrono::milliseconds limit{}, budget{};
        std::string agent{};  // that owned the path, and its start
        std::int64_t epoch = 0;
        std::uint64_t sent = 0;  // the mirror's number of it
        std::chrono::steady_clock::time_point since{};
    };
    bool isGone(const Request& request) const;

    std::vector<Request> unanswered_;  // thread_ alone
    std::atomic<std::chrono::steady_clock::rep> alive_{0};

    mutable std::mutex mutex_;  // of what follows, held for a swap only
    std::condition_variable changed_;
    std::vector<std::string> wanted_;
    std::vector<comms::Viewed> others_;
    std::uint32_t rate_ = 30;
    std::vector<comms::AgentEvent> events_;
    std::vector<Request> requests_;
    std::vector<CommandOutcome> outcomes_;
    std::vector<std::function<void(Holds&)>> holdChanges_;  // in their order
    std::vector<HoldEnd> holdEnds_;
    std::vector<std::string> dismissed_;
    std::optional<std::string> control_;  // wanted; empty: released; none: as it is
    std::string handOverTo_;              // empty: nobody
    std::uint64_t lastNumber_ = 0;
    bool ends_ = false, again_ = false;

    std::shared_ptr<const Frame> frame_;  // written by thread_ alone, which reads it as it is
    std::chrono::steady_clock::time_point published_;  // when frame_ came
    std::thread thread_;                               // last: it uses all of the above
};

}  // namespace cortex::gui
