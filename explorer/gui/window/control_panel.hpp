// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"
#include "widgets/popover.hpp"

#include <string>

class QButtonGroup;
class QLabel;
class QPushButton;

namespace cortex::gui {

// Which part to take control of, and who holds what of it now. Arrows choose the part, Enter takes
// it.
class ControlPanel : public Popover {
    Q_OBJECT
public:
    // The scopes offered: the path, all above it, and everything.
    ControlPanel(std::shared_ptr<const Frame> frame, const std::string& path,
                 QWidget* parent = nullptr);

    void refresh(std::shared_ptr<const Frame> frame);
    QPushButton& takeButton() { return *take_; }
    void choose(const std::string& prefix);
    void focusChosen();

Q_SIGNALS:
    void taken(const std::string& prefix);

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    const std::string& chosen() const;
    QString describe() const;
    QString leaseText(const QString& agent, const comms::ShownLease& lease) const;

    std::shared_ptr<const Frame> frame_;
    std::vector<std::string> scopes_;  // as the buttons
    QButtonGroup* buttons_;
    QLabel* holders_;
    QPushButton *cancel_, *take_;
};

}  // namespace cortex::gui
