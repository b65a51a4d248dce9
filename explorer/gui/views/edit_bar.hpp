// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"
#include "session/agent_start.hpp"
#include "session/commands.hpp"

#include <QWidget>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

class QPushButton;

namespace cortex::gui {

class TextLabel;

// What was entered in the table of data and is not sent yet: all items of a simplex are set
// together or none. It says why not, and what became of it, and can undo it.
class EditBar : public QWidget {
    Q_OBJECT
public:
    EditBar(Commands& commands, ItemModel& items, QWidget* parent = nullptr);

    void setLow(bool low);  // there is little height
    void show(const std::string& path);
    void refresh(const std::shared_ptr<const Frame>& frame, Place place);
    int unsent() const;  // values that were entered, of what is shown
    void submit();       // all of them
    // Enter in a field: without those that were there when the simplex was shown again.
    void submitFresh();
    void forgetRefusal();  // of a value that is put right or given up
    void discard();
    // Sets what was set last here as it was before, unless somebody else has set it since. It needs
    // what setting needs; without it, it can be undone later.
    void undo();

Q_SIGNALS:
    void pressed();  // one of its buttons, which goes then: the keyboard goes back to the table

private:
    // Items that were set, as they were before and as they are now.
    struct Done {
        std::string path;
        comms::Mirror::Arguments before, after;
        AgentStart start;                                 // that was to set them
        std::map<std::string, std::uint64_t> byOthers{};  // how often others had set them by then
        bool came = false;                                // the agent has shown them as set
    };
    struct Sent {
        Done change;
        bool undoes = false;
        std::uint64_t entries = 0;  // that there were when it was sent
    };
    struct Told {
        QString text;
        QColor Tokens::* colour;
        comms::Mirror::Arguments holds{};  // what is said is true while these are the values
        bool held = false;                 // they have been
    };
    using Changes = std::vector<Done>;

    QString whyNot(const comms::Mirror::Arguments& items) const;
    Changes::iterator lastDone();  // of what is shown
    bool isSetByOthers(const Done& change, const std::string& item) const;
    QString whyNotUndone(const Done& change) const;
    void sendEdits(const ItemEdits::Values& edits);
    void sayAside(const std::string& path, const QStringList& items);
    void send(Sent sent);
    void answered(const Sent& sent, const CommandOutcome& outcome);
    void finish(const Sent& sent);
    void finishWhatShows();
    void sayPending();
    // What became of a set stays with its simplex.
    void tell(const std::string& path, const QString& text, QColor Tokens::* colour);
    void say(const QString& text, QColor Tokens::* colour);
    void sayLast();
    void forgetWhatChanged();
    QString textOf(const Done& change) const;
    QString textOf(const std::string& path, const std::string& item, const Value& value) const;

    Commands& commands_;
    ItemModel& items_;
    bool saysWhyNot_ = false;  // of what was not sent, which changes by itself
    bool refused_ = false;     // what is said is of what a person did, until he does something else
    std::shared_ptr<const Frame> frame_;
    Place place_;
    std::string path_;
    std::set<std::string> sending_;             // paths
    std::map<std::string, Sent> unanswered_{};  // by path: it may have been executed
    std::map<std::string, Told> outcomes_;
    Changes done_;  // newest last
    TextLabel* told_;
    QPushButton *set_, *discard_, *undo_;
};

}  // namespace cortex::gui
