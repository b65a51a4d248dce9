// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/axis_reasons.hpp"

#include <QPointer>
#include <string>
#include <vector>

class QScrollArea;
class QVBoxLayout;

namespace cortex::explorer {

class AxisBand;
class Choices;
class LinkRow;

// The axes of a Ds402Processor, a band for each, and the links of their drives. Where there is
// little room, one axis at a time.
class DriveView : public View {
    Q_OBJECT
public:
    explicit DriveView(std::string path);
    ~DriveView() override;

    void bind(const SystemNow& now) override;
    void refresh(const SystemNow& now) override;
    std::vector<Watch> watches() const override;
    bool settled() const override { return frames_ >= laidOut; }

    int count() const { return static_cast<int>(bands_.size()); }
    AxisBand& band(int axis) const { return *bands_.at(static_cast<std::size_t>(axis)); }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void makeBands(const SystemNow& now);
    void makeLinks();
    void arrange();
    void keepChoice(int room);
    void showAxis(int axis);
    void reveal(QWidget* now);
    void order(const Order& order, const QString& title, AxisBand* band);
    void reconnect(LinkRow* row);

    std::string path_;
    std::vector<DriveAxis> axes_;
    std::vector<int> modes_;           // that its type lets choose
    static constexpr int laidOut = 5;  // frames until all has its place
    int frames_ = 0;                   // since the axes came
    int chosen_ = 0;                   // where one axis at a time is shown
    QVBoxLayout *links_, *column_;
    QScrollArea* area_;
    Choices* choice_ = nullptr;  // of an axis
    std::vector<AxisBand*> bands_;
    std::vector<LinkRow*> linkRows_;
};

}  // namespace cortex::explorer
