// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "record/recorder.hpp"
#include "session/frame.hpp"
#include "session/holds.hpp"
#include "session/lease_keeper.hpp"
#include "session/lost_agents.hpp"
#include "session/past_asks.hpp"
#include "session/sent_commands.hpp"

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

// One domain, looked at by a thread of its own: it alone joins, asks and leaves, so that nothing
// the network does can hold up the screen. Called by the GUI thread; no call waits.
class Session {
public:
    // `person`: who uses the window, as all others are told; empty: user@host. Throws Error for a
    // name that no tool may tell.
    explicit Session(comms::NetworkOptions options, const std::string& person = {});
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
    // Asks an agent for what it keeps of a time (UTC ns by its clock, both ends included), and
    // gives a number. Its answer always comes, if only with why there is none.
    std::uint64_t askPast(std::string agent, std::int64_t from, std::int64_t until);
    std::vector<PastAnswer> takePast();  // that came since the last call, each once
    void joinAgain();                    // after it could not join
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
    // it. It is renewed only while isAlive() is called at least once a second. What is wanted of
    // control is done in its order.
    void takeControl(std::string prefix);
    void releaseControl();
    void handOver(std::string to);  // all that is held
    void isAlive();
    // Those for it who hold a part of what lies there, until one of them answers; and what they
    // ask us for.
    void askForControl(std::string prefix);
    void withdrawAsk();
    void grant(comms::LeaseClient::Asked asked);
    void refuse(comms::LeaseClient::Asked asked);

private:
    void run();
    void join();
    void leave();
    void publish();
    using ControlChange = std::function<void(LeaseKeeper&, const Frame&)>;
    void keepCommands();
    void change(ControlChange control);
    void keepControl();
    void keepHolds();
    void keepPast();
    void applyView(std::vector<std::string> wanted, std::vector<comms::Viewed> views,
                   std::uint32_t rate);
    void keepLost(std::vector<AgentFrame>& agents);
    bool pause();  // until the next frame is due; false: the session ends

    comms::NetworkOptions options_;
    std::string person_;
    Recorder recorder_;
    std::unique_ptr<comms::Mirror> mirror_;  // thread_ alone, once it runs
    std::unique_ptr<LeaseKeeper> leases_;    // ends before the mirror; thread_ alone
    std::unique_ptr<Holds> holds_;           // the same
    std::unique_ptr<SentCommands> sent_;     // the same
    std::unique_ptr<PastAsks> past_;         // the same
    std::vector<comms::Viewed> applied_;     // the views that the mirror has; thread_ alone
    std::uint32_t appliedRate_ = 0;          // the same
    LostAgents lost_;                        // thread_ alone
    std::uint64_t number_ = 0, structures_ = 0;
    std::chrono::steady_clock::time_point begin_;
    std::string problem_;

    std::atomic<std::chrono::steady_clock::rep> alive_{0};

    mutable std::mutex mutex_;  // of what follows, held for a swap only
    std::condition_variable changed_;
    std::vector<std::string> wanted_;
    std::vector<comms::Viewed> others_;
    std::uint32_t rate_ = 30;
    std::vector<comms::AgentEvent> events_;
    std::vector<CommandRequest> requests_;
    std::vector<CommandOutcome> outcomes_;
    std::vector<PastAsk> pastAsks_;
    std::vector<PastAnswer> pastAnswers_;
    std::vector<std::function<void(Holds&)>> holdChanges_;  // in their order
    std::vector<HoldEnd> holdEnds_;
    std::vector<std::string> dismissed_;
    std::vector<ControlChange> controlChanges_;  // in their order
    std::uint64_t lastNumber_ = 0;
    bool ends_ = false, again_ = false;

    std::shared_ptr<const Frame> frame_;  // written by thread_ alone, which reads it as it is
    std::chrono::steady_clock::time_point published_;  // when frame_ came
    std::thread thread_;                               // last: it uses all of the above
};

}  // namespace cortex::gui
