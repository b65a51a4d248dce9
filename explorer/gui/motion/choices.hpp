// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>
#include <utility>
#include <vector>

class QPushButton;

namespace cortex::explorer {

// Buttons side by side, of which one is on, as somebody else says: pressing one only asks for it.
class Choices : public QWidget {
    Q_OBJECT
public:
    // A name for the program and the text of each.
    explicit Choices(const std::vector<std::pair<QString, QString>>& choices,
                     QWidget* parent = nullptr);

    void show(const QString& chosen);    // its name; another one: none is on
    void setWhyNot(const QString& why);  // they cannot be pressed; empty: they can
    void rename(const QString& name, const QString& text);
    void keepWidth(int pixels);  // of each at least, so that a name that changes moves none
    QPushButton* button(const QString& name) const;

Q_SIGNALS:
    void wanted(const QString& name);

protected:
    void changeEvent(QEvent* event) override;

private:
    void fit();

    std::vector<std::pair<QString, QPushButton*>> buttons_;
    int leastWidth_ = 0;
};

}  // namespace cortex::explorer
