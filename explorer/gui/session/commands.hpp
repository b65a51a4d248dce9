// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "session/typed_arguments.hpp"

#include <QObject>
#include <QPointer>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cortex::gui {

struct KeptEdits;

// The commands of the window: whoever sends one is called with its outcome. What became of the last
// one of each name stays with its simplex, whatever is shown by then. GUI thread.
class Commands {
public:
    using Done = std::function<void(const CommandOutcome&)>;
    struct Last {
        std::uint64_t number = 0;
        std::optional<CommandOutcome> outcome;  // none: it is on its way
    };

    explicit Commands(Session& session);
    const comms::NetworkOptions& network() const { return session_.options(); }

    // `done` is called once, unless `asker` is gone by then. `keptAs`: the name under which last()
    // has it; the command's, if it is empty.
    void send(const std::string& path, const std::string& command,
              comms::Mirror::Arguments arguments, std::chrono::milliseconds limit, QObject* asker,
              Done done, const std::string& keptAs = {},
              std::chrono::milliseconds budget = std::chrono::seconds{5});
    Session& session() { return session_; }
    TypedArguments& typed() { return typed_; }
    // Items that were entered and not sent, of what no table shows just now.
    const std::shared_ptr<KeptEdits>& keptEdits() const { return keptEdits_; }
    void deliver(const std::vector<CommandOutcome>& outcomes);
    const Last* last(const std::string& path, const std::string& name) const;  // null: none

    // Who has set items is among the events. `self`: how agents know this window.
    void hear(const std::vector<comms::AgentEvent>& events, const std::string& self);
    // How often others have set the item, or may have.
    std::uint64_t setByOthers(const std::string& path, const std::string& item) const;

private:
    using Key = std::pair<std::string, std::string>;  // path and name
    struct Asked {
        QPointer<QObject> asker;
        Done done;
        Key key;
    };
    Session& session_;
    TypedArguments typed_;
    std::shared_ptr<KeptEdits> keptEdits_;
    std::map<std::uint64_t, Asked> asked_;
    std::map<Key, Last> last_;
    // By path and item; an empty one: any of them.
    std::map<Key, std::uint64_t> setByOthers_;
};

}  // namespace cortex::gui
