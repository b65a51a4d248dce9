// SPDX-License-Identifier: Apache-2.0
// Messages of each kind, with any content and of any size, from one process to another. Both make
// the same ones of a seed, so what arrives is compared with what was written.
#include "comms/any_messages.hpp"
#include "comms/inbox.hpp"
#include "comms/secured_plant.hpp"
#include "dds/participant.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr std::chrono::seconds slice{2};  // in which what is not lost has come

std::uint64_t numberOf(const char* variable, std::uint64_t otherwise) {
    const char* const given = std::getenv(variable);
    return given != nullptr ? std::stoull(given) : otherwise;
}

// Of all messages of a run: the same one each time, unless many are asked for.
std::uint64_t seedOfRun() {
    static const std::uint64_t seed =
        numberOf("CORTEX_SEED", std::getenv("CORTEX_MESSAGES") ? std::random_device{}() : 1);
    return seed;
}

// The process that writes.
class AnyWriter {
public:
    explicit AnyWriter(const std::string& security) {
        int input[2];
        if (pipe(input) != 0) throw std::runtime_error{"no pipe"};
        const std::string domain = std::to_string(loopback().domain);
        process_ = fork();
        if (process_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            dup2(input[0], STDIN_FILENO);
            close(input[0]);
            close(input[1]);
            const char* const folder = security.empty() ? nullptr : security.c_str();
            execl(CORTEX_BINARY_DIR "/bin/any-writer", "any-writer", domain.c_str(), folder,
                  nullptr);
            _exit(127);
        }
        close(input[0]);
        input_ = fdopen(input[1], "w");
    }
    ~AnyWriter() {
        std::fclose(input_);
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    AnyWriter(const AnyWriter&) = delete;
    AnyWriter& operator=(const AnyWriter&) = delete;

    void ask(const std::string& kind, std::uint64_t seed, std::size_t count, std::size_t most) {
        std::fprintf(input_, "%s %lu %zu %zu\n", kind.c_str(), seed, count, most);
        std::fflush(input_);
    }
    // "; the process that writes ended with …", or nothing.
    std::string end() const {
        const std::string how = test::howItEnded(process_);
        return how.empty() ? "" : "; the process that writes " + how;
    }

private:
    pid_t process_;
    std::FILE* input_;
};

struct Open {
    static constexpr std::size_t share = 1;
    NetworkOptions options(const std::string&) const { return loopback(); }
};

struct Signed {
    static constexpr std::size_t share = 2;
    NetworkOptions options(const std::string& name) const {
        NetworkOptions options = loopback();
        options.security = plant.make(name);
        return options;
    }
    SecuredPlant plant;
};

template <class Network>
class WireOfTwoProcesses : public testing::Test {
protected:
    // Several are written together where none may get lost. One that may be lost is written again.
    void compare(const std::string& kind, std::size_t count, std::size_t most) {
        forKind(kind, [&]<class M>(const Topic& topic) {
            Inbox<M> inbox;
            const auto reader = to.template reader<M>(topic, inbox.push());
            const bool mayBeLost = topic.qos == Qos::Cycle;
            std::mt19937_64 random{seedOfRun()};
            last_.clear();
            for (std::size_t done = 0; done < count && !this->HasFailure();) {
                const std::size_t together = mayBeLost ? 1 : 1 + random() % 8;
                const std::uint64_t seed = random() >> 1;
                writer.ask(kind, seed, together, most);
                bool came = false;
                for (auto left = test::patience / slice; left > 0 && writer.end().empty(); --left) {
                    came = inbox.waitUntil(
                        [&](const auto& all) {
                            const auto old =
                                mayBeLost ? std::ranges::count(all, last_, &Content::of<M>) : 0;
                            return all.size() - static_cast<std::size_t>(old) >= together;
                        },
                        slice);
                    if (came) break;
                    if (mayBeLost) writer.ask(kind, seed, together, most);
                }
                ASSERT_TRUE(came) << kind << " of seed " << seed << " and at most " << most
                                  << " octets: " << inbox.elements().size() << " of " << together
                                  << " came; "
                                  << (writer.end().empty()
                                          ? "the others did not come in " +
                                                std::to_string(test::patience.count()) + " s"
                                          : writer.end());
                compareThese(kind, inbox.take(), together, seed, most, mayBeLost);
                done += together;
            }
        });
        EXPECT_EQ(to.malformed(), 0U) << kind;
    }
    // DDS keeps the order within one key. One that was written again may come twice, the second
    // time after the next one was asked for.
    template <class M>
    void compareThese(const std::string& kind, std::vector<M> came, std::size_t count,
                      std::uint64_t seed, std::size_t most, bool mayComeAgain) {
        std::vector<std::pair<Id, Octets>> missing;  // in the order in which they were written
        for (std::size_t i = 0; i < count; ++i) {
            M message = anyMessage<M>(seed + i, most);
            missing.emplace_back(keyOf(message), Content::of(message));
        }
        const Octets newest = missing.back().second;
        for (M& each : came) {
            const Octets is = Content::of(each);
            if (mayComeAgain && (is == last_ || (missing.empty() && is == newest))) continue;
            ASSERT_FALSE(missing.empty()) << kind << ": more came than were written";
            const auto found = std::ranges::find(missing, is, &std::pair<Id, Octets>::second);
            ASSERT_NE(found, missing.end())
                << kind << " of a seed from " << seed << " on and at most " << most
                << " octets: " << whereItDiffers(is, missing.front().second);
            const auto first =
                std::ranges::find(missing, keyOf(each), &std::pair<Id, Octets>::first);
            ASSERT_EQ(first, found) << kind << " of a seed from " << seed
                                    << " on: one came before an earlier one of its key";
            missing.erase(found);
        }
        last_ = mayComeAgain ? newest : Octets{};
    }
    static std::string whereItDiffers(const Octets& is, const Octets& expected) {
        const auto at = std::ranges::mismatch(is, expected).in1 - is.begin();
        return std::to_string(is.size()) + " of " + std::to_string(expected.size()) +
               " octets of content came; octet " + std::to_string(at) +
               " is the first that differs";
    }

    const Network network{};
    const NetworkOptions writers = network.options(anySender), readers = network.options("to");
    AnyWriter writer{writers.security};
    Participant to{readers, "to"};

private:
    Octets last_;  // the content of the last that may come again
};

using Networks = testing::Types<Open, Signed>;
TYPED_TEST_SUITE(WireOfTwoProcesses, Networks);

TYPED_TEST(WireOfTwoProcesses, CarriesAnyContentOfEachKindAsItIs) {
    const std::size_t count = numberOf("CORTEX_MESSAGES", 60 / TypeParam::share);
    std::printf("CORTEX_SEED=%lu CORTEX_MESSAGES=%zu\n", seedOfRun(), count);
    for (const char* kind : {"presence", "model", "interest", "view", "link", "summary", "command",
                             "answer", "event", "past"}) {
        this->compare(kind, count, maxInOneDatagram);
    }
}

TYPED_TEST(WireOfTwoProcesses, CarriesLargeBlocksAndModelsAsTheyAre) {
    const bool many = std::getenv("CORTEX_MESSAGES") != nullptr;
    this->compare("presence", 1, 100);  // whose blocks they are is known by a message with a name
    for (const std::size_t most : {100'000U, 1'000'000U, many ? 15'000'000U : 1'000'000U}) {
        this->compare("link", 1, most);
        this->compare("view", 1, most);
        this->compare("model", 1, most);
    }
}

}  // namespace
}  // namespace cortex::comms
