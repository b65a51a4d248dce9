// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/cursor_overlay.hpp"
#include "plots/drawn_line.hpp"
#include "plots/plot_history.hpp"
#include "plots/plot_lines.hpp"
#include "plots/plot_range.hpp"

#include <QElapsedTimer>
#include <QJsonObject>
#include <QWidget>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class QVBoxLayout;

namespace cortex::gui {

class DropZone;
class LaneStrip;
class OverviewStrip;
class PlotBar;
class PlotLegend;
class PlotPanel;
class PlotPointer;
class TagStrip;
class TextLabel;
class TimeAxis;

// Where a line goes: to a panel (-1: to that of its unit), or to a new one before it.
struct PlotPlace {
    int panel = -1;
    bool anew = false;
};

// Lines over time: panels with one time axis, lanes of words, a legend. It records what it shows.
class PlotView : public QWidget {
    Q_OBJECT
public:
    explicit PlotView(Recorder& recorder, QWidget* parent = nullptr);
    ~PlotView() override;  // what it alone recorded is forgotten

    // Of the agents that have them; to that panel, or to a new one before it.
    void add(const std::vector<RecordedItem>& items, int panel = -1, bool anew = false);
    void removeLine(int tag);
    void moveLine(int tag, int panel, bool anew = false);
    void undo();  // of the last line or panel that was added, removed or moved
    const PlotHistory& history() const { return history_; }
    const DropZone& zone() const { return *zone_; }           // seen while something is dragged
    void refresh(const std::shared_ptr<const Frame>& frame);  // after Recorder::take()
    QJsonObject saved() const;
    void restore(const QJsonObject& saved);

    PlotRange& range() { return range_; }
    Cursors& cursors() { return cursors_; }
    void setUnits(const ShownUnits& units);
    const ShownUnits& units() const { return lines_.units(); }
    const PlotLines& lines() const { return lines_; }
    std::vector<DrawnLine> drawn() const;
    const std::vector<PlotPanel*>& panels() const { return panels_; }
    TimeSpan kept() const;  // of the line that is kept longest, up to now
    PlotLegend& legend() { return *legend_; }
    // Why not every cycle is kept, and whose clock is wrong; otherwise empty.
    QString notice() const { return notice_; }

    void toggleCursors();
    void toggleStatistics();
    void showLegend(bool wanted);  // with the statistics
    void redraw();                 // what is there, as it is now
    // By its ending: .csv, .png, .svg. Empty, or why it was not written.
    QString exportTo(const QString& file);
    void exportAndTell(const QString& file);  // and says what became of it

Q_SIGNALS:
    void changed();  // something that a layout keeps

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool focusNextPrevChild(bool next) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dragMoveEvent(QDragMoveEvent* event) override;
    void dragLeaveEvent(QDragLeaveEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

private:
    friend class PlotPointer;
    void build();
    void fitPanels();
    void alignEdges();
    void showTags();
    void record();
    void advance();
    bool shiftClocks();
    void showNotices();
    void openMenu(int tag, const QPoint& at);
    void askForFile(const QString& kind);
    void change(const QString& words, const std::function<bool(PlotLines&)>& act);
    PlotPlace placeAt(const QPoint& at) const;  // in this view
    QRect boxOf(PlotPlace place) const;
    static bool put(PlotLines& lines, const std::vector<RecordedItem>& items, PlotPlace place);
    void outline(const std::vector<RecordedItem>& items, const QPoint& at);
    void dragTag(int tag, const QPoint& global);
    void dropTag(int tag, const QPoint& global);
    QRect plotBox() const;  // of all canvases, in the column
    double secondsAt(int x) const;
    double secondsOfPixel() const;

    Recorder& recorder_;
    std::shared_ptr<const Frame> frame_;
    PlotLines lines_;
    PlotHistory history_;
    PlotRange range_;
    Cursors cursors_;
    char chosen_ = 0;  // the cursor that keys move
    PlotBar* bar_;
    TextLabel *empty_, *hint_, *foot_;
    QWidget *body_, *column_, *side_ = nullptr;
    QVBoxLayout* stack_;
    std::vector<PlotPanel*> panels_;
    std::vector<TagStrip*> tags_;
    LaneStrip* lanes_;
    TimeAxis* axis_;
    OverviewStrip* overview_;
    PlotLegend* legend_;
    CursorOverlay* overlay_;
    DropZone* zone_;
    PlotPointer* pointer_;
    QString notice_, written_, notWritten_;       // what became of the last export
    QElapsedTimer silence_;                       // since anything came
    double newest_ = 0;                           // s, UTC, of anything
    std::map<std::string, std::int64_t> shifts_;  // of the clocks of agents, as they are drawn
    int frames_ = 0;
};

}  // namespace cortex::gui
