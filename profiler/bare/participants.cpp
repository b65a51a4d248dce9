// SPDX-License-Identifier: Apache-2.0
// How long many bare participants of Fast DDS on one host, started at once, take to find each
// other: each is a process with the endpoints of an agent and nothing else of ours, that writes
// nothing. What agents take beside that (many_agents.sh) is ours.
#include "octets.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

namespace {

namespace dds = eprosima::fastdds::dds;
using cortex::bare::Octets;
using eprosima::fastrtps::Duration_t;

struct Endpoint {
    const char* topic;
    bool writes, keyed, reliable, lateJoiners;
    int depth;
    std::uint32_t heartbeat;  // ms
};

// Those of an agent without views: comms/src/agent_thread.cpp and participant_qos.cpp. The last two
// are of one that links.
constexpr std::array endpoints{
    Endpoint{"cortex/presence", true, true, true, true, 1, 300},
    Endpoint{"cortex/1/model", true, true, true, true, 1, 100},
    Endpoint{"cortex/1/event", true, true, true, true, 1000, 100},
    Endpoint{"cortex/presence", false, true, false, false, 1, 0},
    Endpoint{"cortex/1/interest", false, true, true, true, 1, 0},
    Endpoint{"cortex/1/command", false, true, true, false, 64, 0},
    Endpoint{"cortex/1/model", false, true, true, true, 1, 0},
    Endpoint{"cortex/1/interest", true, true, true, true, 1, 100},
};

std::span<const Endpoint> endpointsOf(std::string_view settings) {
    return std::span{endpoints}.first(settings == "cortex-links" ? 8 : 6);
}

bool hasCounterpart(const Endpoint& endpoint, std::span<const Endpoint> all) {
    return std::ranges::any_of(all, [&](const Endpoint& other) {
        return other.writes != endpoint.writes && std::string_view{other.topic} == endpoint.topic;
    });
}

Duration_t milliseconds(std::uint32_t count) {
    return {static_cast<std::int32_t>(count / 1000), count % 1000 * 1'000'000};
}

// --- one participant ----------------------------------------------------------------------------

// Hears how many others one endpoint has found.
class Matches final : public dds::DataWriterListener, public dds::DataReaderListener {
public:
    explicit Matches(bool needed) : needed_{needed} {}

    bool complete(int others) {
        const std::lock_guard lock{mutex_};
        return !needed_ || count_ >= others;
    }

private:
    void on_publication_matched(dds::DataWriter* /*writer*/,
                                const dds::PublicationMatchedStatus& status) override {
        const std::lock_guard lock{mutex_};
        count_ = status.current_count;
    }
    void on_subscription_matched(dds::DataReader* /*reader*/,
                                 const dds::SubscriptionMatchedStatus& status) override {
        const std::lock_guard lock{mutex_};
        count_ = status.current_count;
    }

    const bool needed_;
    std::mutex mutex_;
    int count_ = 0;
};

dds::DomainParticipantQos participantQos(bool ours) {
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(
        std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>());
    auto& builtin = qos.wire_protocol().builtin;
    builtin.mutation_tries = 300;
    if (ours) {
        builtin.discovery_config.leaseDuration = milliseconds(10'000);
        builtin.discovery_config.leaseDuration_announcementperiod = milliseconds(1'000);
    }
    return qos;
}

template <class Qos>
void apply(const Endpoint& endpoint, Qos& qos) {
    qos.reliability().kind =
        endpoint.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind =
        endpoint.lateJoiners ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = endpoint.depth;
    qos.resource_limits().max_samples = 0;  // 0: unlimited
    qos.resource_limits().max_instances = 0;
    qos.resource_limits().max_samples_per_instance = 0;
    qos.data_sharing().off();
}

class Participant {
public:
    Participant(int domain, std::string_view settings)
        : participant_{factory()->create_participant(static_cast<dds::DomainId_t>(domain),
                                                     participantQos(settings != "default"))} {
        if (!participant_) throw std::runtime_error{"Fast DDS refused a participant"};
        publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
        subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
        for (const bool keyed : {false, true}) {
            dds::TypeSupport{new Octets{keyed}}.register_type(participant_);
        }
        const auto all = endpointsOf(settings);
        for (const Endpoint& each : all) add(each, hasCounterpart(each, all));
    }

    bool complete(int others) {
        return std::ranges::all_of(matches_, [=](auto& each) { return each->complete(others); });
    }

private:
    static dds::DomainParticipantFactory* factory() {
        return dds::DomainParticipantFactory::get_instance();
    }
    void add(const Endpoint& endpoint, bool needed) {
        auto* topic =
            dynamic_cast<dds::Topic*>(participant_->lookup_topicdescription(endpoint.topic));
        if (!topic) {
            topic = participant_->create_topic(
                endpoint.topic, endpoint.keyed ? "KeyedOctets" : "Octets", dds::TOPIC_QOS_DEFAULT);
        }
        matches_.push_back(std::make_unique<Matches>(needed));
        if (endpoint.writes) {
            dds::DataWriterQos qos;
            apply(endpoint, qos);
            qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
            if (endpoint.reliable) {
                qos.reliable_writer_qos().times.heartbeatPeriod = milliseconds(endpoint.heartbeat);
            }
            publisher_->create_datawriter(topic, qos, matches_.back().get());
        } else {
            dds::DataReaderQos qos;
            apply(endpoint, qos);
            subscriber_->create_datareader(topic, qos, matches_.back().get());
        }
    }

    std::vector<std::unique_ptr<Matches>> matches_;
    dds::DomainParticipant* participant_;
    dds::Publisher* publisher_ = nullptr;
    dds::Subscriber* subscriber_ = nullptr;
};

// --- all of them --------------------------------------------------------------------------------

std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

bool readable(int descriptor, std::int64_t wait) {
    pollfd input{descriptor, POLLIN, 0};
    return poll(&input, 1, static_cast<int>(wait)) > 0;
}

// Says when it had found all others, and stays until its standard input ends.
int runOne(int others, int domain, std::string_view settings) {
    Participant participant{domain, settings};
    while (!participant.complete(others)) {
        if (readable(STDIN_FILENO, 20)) _exit(1);
    }
    std::printf("%lld\n", static_cast<long long>(now()));
    std::fflush(stdout);
    readable(STDIN_FILENO, -1);
    _exit(0);  // nobody is to hear goodbyes
}

struct Options {
    int count = 0, seconds = 60, domain = 1 + getpid() % 99;
    std::string settings = "default";
};

pid_t startOne(const Options& options, int input, int output) {
    const std::vector<std::string> words{"cortex-bare-participants", "--one",
                                         std::to_string(options.count - 1),
                                         std::to_string(options.domain), options.settings};
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t process = fork();
    if (process == 0) {
        dup2(input, STDIN_FILENO);
        dup2(output, STDOUT_FILENO);
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    return process;
}

// The times that come as lines until there are so many or the time is over.
std::vector<std::int64_t> timesFrom(int descriptor, std::size_t count, std::int64_t end) {
    std::string text;
    std::array<char, 4096> part{};
    const auto lines = [&] { return static_cast<std::size_t>(std::ranges::count(text, '\n')); };
    while (lines() < count && readable(descriptor, std::max<std::int64_t>(end - now(), 0))) {
        const ssize_t size = read(descriptor, part.data(), part.size());
        if (size <= 0) break;
        text.append(part.data(), static_cast<std::size_t>(size));
    }
    std::vector<std::int64_t> times;
    for (std::size_t at = 0, line = 0; line < lines(); ++line, at = text.find('\n', at) + 1) {
        times.push_back(std::strtoll(text.c_str() + at, nullptr, 10));
    }
    std::ranges::sort(times);
    return times;
}

int runAll(const Options& options) {
    int input[2], output[2];
    if (pipe2(input, O_CLOEXEC) != 0 || pipe2(output, O_CLOEXEC) != 0) return 1;
    const std::int64_t start = now();
    std::vector<pid_t> processes;
    for (int i = 0; i < options.count; ++i) {
        processes.push_back(startOne(options, input[0], output[1]));
    }
    const std::int64_t launched = now() - start;
    const auto count = static_cast<std::size_t>(options.count);
    const std::vector<std::int64_t> times =
        timesFrom(output[0], count, start + options.seconds * 1000);
    double load = 0;
    getloadavg(&load, 1);
    close(input[1]);
    for (const pid_t each : processes) waitpid(each, nullptr, 0);

    std::printf(
        "%d bare participants of %zu endpoints, discovery settings: %s, load %.2f:"
        " launched within %lld ms\n",
        options.count, endpointsOf(options.settings).size(), options.settings.c_str(), load,
        static_cast<long long>(launched));
    std::printf("%zu of %zu found all others", times.size(), count);
    if (!times.empty()) {
        std::printf(
            ", the first %lld ms after the first start, half of them %lld ms, the last"
            " %lld ms",
            static_cast<long long>(times.front() - start),
            static_cast<long long>(times[times.size() / 2] - start),
            static_cast<long long>(times.back() - start));
    }
    std::printf("\n");
    return times.size() == count ? 0 : 1;
}

bool known(std::string_view settings) {
    return settings == "default" || settings == "cortex" || settings == "cortex-links";
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> words{argv + 1, argv + argc};
        if (words.size() == 4 && words[0] == "--one") {
            return runOne(std::stoi(words[1]), std::stoi(words[2]), words[3]);
        }
        Options options;
        if (!words.empty()) options.count = std::atoi(words[0].c_str());
        if (words.size() > 1) options.settings = words[1];
        if (words.size() > 2) options.seconds = std::atoi(words[2].c_str());
        if (words.size() > 3 || options.count < 2 || options.seconds < 1 ||
            !known(options.settings)) {
            std::fputs(
                "usage: cortex-bare-participants COUNT [default|cortex|cortex-links [SECONDS]]\n"
                "  default, cortex: whose settings of discovery; cortex-links: with the endpoints"
                " of agents that link\n"
                "  SECONDS: exit code 1 if they have not found each other by then (60)\n",
                stderr);
            return 2;
        }
        return runAll(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
