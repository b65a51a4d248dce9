// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/commands.hpp"

#include <QWidget>
#include <array>

class QPushButton;

namespace cortex::gui {

class TextLabel;

// Startup, Shutdown and Clear faults of an active simplex, with the reasons why not below them.
class LifeCycleBar : public QWidget {
    Q_OBJECT
public:
    explicit LifeCycleBar(Commands& commands, QWidget* parent = nullptr);

    void show(const std::string& path);
    // For the reasons below the buttons, from the next refresh on; 0: they stand elsewhere.
    void setLines(int lines);
    void refresh(const Frame& frame, Place place);
    QString reasons() const;  // of all buttons, equal ones once

    QSize sizeHint() const override;         // with room for most reasons
    QSize minimumSizeHint() const override;  // with room for the buttons

Q_SIGNALS:
    void told(const QString& outcome);  // of the last one to what is shown; empty: none was sent

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void fit();
    int leastWidth() const;  // of a button, so that none is cut in any language or size of text
    QSize sizeWith(int width) const;
    struct Button {
        std::string command;
        QPushButton* button;
        TextLabel* reason;
    };
    void tell();

    Commands& commands_;
    std::string path_;
    QString told_;
    int lines_ = 2;            // of each reason
    int kept_ = 0, wide_ = 0;  // the most that they needed so far, at this width; px
    QString readOnly_;         // why not without control
    std::array<Button, 3> buttons_;
};

}  // namespace cortex::gui
