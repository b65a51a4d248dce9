// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"
#include "widgets/popover.hpp"

#include <string>

class QButtonGroup;
class QPushButton;

namespace cortex::gui {

class HolderLines;

// Which part to take control of, and who holds what of it now. Arrows choose the part, Enter takes
// it. Who holds a part of it can be asked for it. Nothing moves while it is open: what is said
// scrolls in a place of its own.
class ControlPanel : public Popover {
    Q_OBJECT
public:
    // The scopes offered: the path, all above it, and everything.
    ControlPanel(std::shared_ptr<const Frame> frame, const std::string& path,
                 QWidget* parent = nullptr);

    void refresh(std::shared_ptr<const Frame> frame);
    QPushButton& takeButton() { return *take_; }
    QPushButton& askButton() const {
        return *ask_;
    }  // or withdraws what is asked; hidden: nobody is
    void choose(const std::string& prefix);
    void focusChosen();

Q_SIGNALS:
    void taken(const std::string& prefix);
    void asked(const std::string& prefix);
    void withdrawn();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    const std::string& chosen() const;
    // As it is, or as if somebody held this of every agent.
    QString describe(const std::string& prefix, const comms::ShownLease* held = nullptr) const;
    QString longest() const;
    QString leaseText(const QString& agent, const comms::ShownLease& lease) const;
    QString whyNotAsked(const std::string& prefix) const;
    bool asks() const;
    void showAsk();

    std::shared_ptr<const Frame> frame_;
    std::vector<std::string> scopes_;  // as the buttons
    QButtonGroup* buttons_;
    HolderLines* holders_;
    QPushButton *ask_, *cancel_, *take_;
};

}  // namespace cortex::gui
