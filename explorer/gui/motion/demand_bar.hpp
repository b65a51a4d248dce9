// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>
#include <optional>
#include <vector>

class QPushButton;

namespace cortex::explorer {

class Sentence;

// What was entered for the axes and is not sent yet, and what is done with it.
class DemandBar : public QWidget {
    Q_OBJECT
public:
    explicit DemandBar(QWidget* parent = nullptr);

    void forget(std::size_t axes);
    // A wrong one is kept as none, and stops the motion.
    void enter(std::size_t axis, std::optional<double> demand);
    void discard();
    bool isEdited(std::size_t axis) const { return edits_[axis].edited; }
    std::optional<double> entered(std::size_t axis) const { return edits_[axis].demand; }
    int edited() const;    // how many
    bool isWrong() const;  // any of them

    void show(const QString& action, const QString& whyNot, const QString& note);
    void say(const QString& answer);  // what came of it
    QPushButton& copyButton() const { return *copy_; }
    QPushButton& discardButton() const { return *discard_; }
    QPushButton& haltButton() const { return *halt_; }
    QPushButton& moveButton() const { return *move_; }
    QString answer() const;

private:
    struct Edit {
        bool edited = false;
        std::optional<double> demand{};
    };
    std::vector<Edit> edits_;
    QPushButton *copy_, *discard_, *halt_, *move_;
    Sentence *note_, *answer_;
};

}  // namespace cortex::explorer
