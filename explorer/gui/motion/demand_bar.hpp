// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>
#include <optional>
#include <vector>

class QGridLayout;
class QPushButton;

namespace cortex::explorer {

class Sentence;

// What was entered for the axes, what is done with it, and what came of that.
class DemandBar : public QWidget {
    Q_OBJECT
public:
    explicit DemandBar(QWidget* parent = nullptr);

    void forget(std::size_t axes);
    // A wrong one is kept as none, and stops the motion.
    void enter(std::size_t axis, std::optional<double> demand);
    void discard();
    // All of it is being sent for a motion of one axis or, without one, of all: its number.
    int send(std::optional<std::size_t> axis);
    // The controller has it, and now moves this axis or all.
    void taken(int motion, std::optional<std::size_t> axis);
    // What came of it. Where it was refused, what was sent for it is marked until it is sent anew.
    void answer(int motion, bool done);

    bool has(std::size_t axis) const { return edits_[axis].stage != Stage::None; }
    // The agent does not have it: it was not sent, or refused.
    bool isMarked(std::size_t axis) const { return isMarked(edits_[axis]); }
    std::optional<double> entered(std::size_t axis) const { return edits_[axis].demand; }
    QString counts() const;  // "2 not sent"
    bool isWrong() const;    // any of them

    // `wrong`: what is wrong with a demand that can be sent nevertheless.
    void show(const QString& action, const QString& whyNot, const QString& wrong,
              const QString& note);
    void say(const QString& answer);  // what came of it
    QPushButton& copyButton() const { return *copy_; }
    QPushButton& discardButton() const { return *discard_; }
    QPushButton& haltButton() const { return *halt_; }
    QPushButton& moveButton() const { return *move_; }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    enum class Stage { None, Entered, Sent, Refused };
    struct Edit {
        Stage stage = Stage::None;
        std::optional<double> demand{};
        int motion = 0;  // that it was sent for
    };
    static bool isMarked(const Edit& edit) {
        return edit.stage == Stage::Entered || edit.stage == Stage::Refused;
    }
    static bool isSent(const Edit& edit, int motion) {
        return edit.stage == Stage::Sent && edit.motion == motion;
    }
    int count(Stage stage) const;
    void arrange();

    std::vector<Edit> edits_;
    int motion_ = 0;  // the last one
    QPushButton *copy_, *discard_, *halt_, *move_;
    Sentence *note_, *answer_;
    QWidget* texts_;
    QGridLayout* grid_;
    std::optional<bool> wide_{};
};

}  // namespace cortex::explorer
