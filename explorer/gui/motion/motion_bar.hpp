// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>
#include <utility>
#include <vector>

class QLabel;
class QSlider;

namespace cortex::explorer {

class Choices;
class Sentence;

// Above the axes: the share of the greatest speed, the units, and what the controller lets choose.
class MotionBar : public QWidget {
    Q_OBJECT
public:
    // What is chosen, such as its mode: a name for the program and the text of each. None: nothing.
    MotionBar(const QString& mode, const std::vector<std::pair<QString, QString>>& modes,
              QWidget* parent = nullptr);

    double share() const;  // 0.01 to 1; 0.1 at the beginning, always
    // Whether it may move anything. Whenever that begins, as with control, the share is 0.1 again.
    void setAllowed(bool allowed);
    QSlider& slider() const { return *slider_; }
    Choices& modes() const { return *modes_; }
    Choices& angles() const { return *angles_; }
    Choices& lengths() const { return *lengths_; }
    void saySpeed(const QString& text);
    void sayMode(const QString& text);  // empty: there is nothing to say

Q_SIGNALS:
    void shareChanged();

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void layOut(bool hasModes);

    bool allowed_ = false;
    QSlider* slider_;
    QLabel* percent_;
    Sentence* speed_;
    Choices *angles_, *lengths_, *modes_;
    QLabel* modeName_;
    Sentence* mode_;
};

}  // namespace cortex::explorer
