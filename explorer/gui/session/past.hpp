// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"

#include <QObject>
#include <QPointer>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace cortex::gui {

// What views ask agents for of the past: whoever asks is called with the answer. GUI thread.
class Past {
public:
    using Done = std::function<void(comms::PastEvents)>;

    explicit Past(Session& session) : session_{session} {}

    // `done` is called once, from deliver(), unless `asker` is gone by then.
    void ask(const std::string& agent, std::int64_t from, std::int64_t until, QObject* asker,
             Done done);
    void deliver();

private:
    struct Asked {
        QPointer<QObject> asker;
        Done done;
    };
    Session& session_;
    std::map<std::uint64_t, Asked> asked_;
};

}  // namespace cortex::gui
