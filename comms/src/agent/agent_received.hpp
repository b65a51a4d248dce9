// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace cortex::comms {

template <class Message>
struct Arrived {
    Message message;
    std::int64_t time;  // monotonicNow() when it came
};

struct ReceivedMessages {
    std::vector<Arrived<Presence>> presences;
    std::vector<Arrived<Model>> models;
    std::vector<Arrived<Interest>> interests;
    std::vector<Arrived<Command>> commands;
    std::vector<Arrived<Answer>> answers;
};

// Carries messages from the threads of DDS to the communication thread. It is bounded. Any thread.
class ReceivedQueue {
public:
    // False: it is full, and the message is dropped.
    bool push(Presence&& message, std::int64_t now) {
        return add(&ReceivedMessages::presences, message, now, 4'096);
    }
    bool push(Model&& message, std::int64_t now) {
        return add(&ReceivedMessages::models, message, now, 300'000);
    }
    bool push(Interest&& message, std::int64_t now) {
        return add(&ReceivedMessages::interests, message, now, 4'096);
    }
    bool push(Command&& message, std::int64_t now) {
        return add(&ReceivedMessages::commands, message, now, 4'096);
    }
    bool push(Answer&& message, std::int64_t now) {
        return add(&ReceivedMessages::answers, message, now, 4'096);
    }
    // Takes all messages, in exchange for `emptied`, whose memory is used again.
    void take(ReceivedMessages& emptied) {
        const std::lock_guard lock{mutex_};
        std::swap(messages_, emptied);
    }

private:
    template <class Message>
    bool add(std::vector<Arrived<Message>> ReceivedMessages::* list, Message& message,
             std::int64_t now, std::size_t most) {
        const std::lock_guard lock{mutex_};
        if ((messages_.*list).size() >= most) return false;
        (messages_.*list).push_back({std::move(message), now});
        return true;
    }

    std::mutex mutex_;
    ReceivedMessages messages_;
};

}  // namespace cortex::comms
