// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/agent_start.hpp"
#include "session/commands.hpp"

#include <QWidget>
#include <vector>

class QGridLayout;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace cortex::gui {

class TextLabel;
class ValueField;

// One command of a simplex as a form: what it does, a field for each parameter, Run with the reason
// why not, progress and Cancel of a long one, what became of the last: also of one that was sent
// before this form was made. All of it has its place from the beginning: nothing that comes moves
// anything.
class CommandCard : public QWidget {
    Q_OBJECT
public:
    CommandCard(Commands& commands, std::string path, const Command& command,
                QWidget* parent = nullptr);

    void refresh(const Frame& frame, Place place);
    void run();        // asks first where the type says so
    bool takeFocus();  // in its first field, otherwise on Run; false: that is off
    const Command& command() const { return command_; }

protected:
    void keyPressEvent(QKeyEvent* event) override;  // Ctrl+Enter

private:
    void addParameter(QGridLayout& grid, const DataItem& item);
    void addRun(QVBoxLayout& rows);
    void addCancel(QVBoxLayout& rows);
    void addCopy();
    void fit();
    comms::Mirror::Arguments arguments() const;
    QString whyNotRun() const;  // empty: it can be sent
    void decide();
    void ask();
    void send();
    void cancel();
    void refreshProgress(const AgentFrame& agent, std::uint32_t simplex);
    void showOutcomes();
    void openAnswer();
    std::string cancelName() const { return "cancel " + command_.name; }

    Commands& commands_;
    std::string path_;
    Command command_;   // a copy: the agent's types may go
    AgentStart owner_;  // of the path just now
    QString whyNot_;    // from outside of the form
    bool isSending_ = false, runs_ = false;
    std::string shown_;  // which outcomes are shown
    QString answer_;     // all of them
    QString requested_;  // how far a long one is, and who asked for it
    std::vector<ValueField*> fields_;
    QPushButton *run_, *whole_, *cancel_;
    TextLabel *told_, *reason_, *progressText_;
    QProgressBar* progress_;
};

}  // namespace cortex::gui
