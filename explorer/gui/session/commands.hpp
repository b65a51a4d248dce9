// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"

#include <QObject>
#include <QPointer>
#include <functional>
#include <map>

namespace cortex::explorer {

// The commands of the window: whoever sends one is called with its outcome. GUI thread.
class Commands {
public:
    using Done = std::function<void(const CommandOutcome&)>;

    explicit Commands(Session& session) : session_{session} {}
    const comms::NetworkOptions& network() const { return session_.options(); }

    // `done` is called once, unless `asker` is gone by then.
    void send(const std::string& path, const std::string& command,
              comms::Mirror::Arguments arguments, std::chrono::milliseconds limit, QObject* asker,
              Done done);
    void deliver(const std::vector<CommandOutcome>& outcomes);

private:
    struct Asked {
        QPointer<QObject> asker;
        Done done;
    };
    Session& session_;
    std::map<std::uint64_t, Asked> asked_;
};

}  // namespace cortex::explorer
