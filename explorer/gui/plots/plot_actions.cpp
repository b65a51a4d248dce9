// SPDX-License-Identifier: Apache-2.0
// What keys and menus do to a plot, and what is kept of it.
#include "model/whole_file.hpp"
#include "plots/plot_csv.hpp"
#include "plots/plot_legend.hpp"
#include "plots/plot_panel.hpp"
#include "plots/plot_report.hpp"
#include "plots/plot_view.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"
#include "widgets/unit_menu.hpp"

#include <QBuffer>
#include <QContextMenuEvent>
#include <QFileDialog>
#include <QJsonArray>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>
#include <QSvgGenerator>
#include <array>
#include <sstream>
#include <utility>

namespace cortex::gui {

namespace {

constexpr double panShare = 0.1, zoomFactor = 0.8;

}  // namespace

void PlotView::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Undo)) return undo();
    const TimeSpan span = range_.shown();
    const bool left = event->key() == Qt::Key_Left;
    switch (event->key()) {
        case Qt::Key_Space:
            range_.follows() ? range_.hold() : range_.follow();
            break;
        case Qt::Key_F:
        case Qt::Key_End:
            range_.follow();
            break;
        case Qt::Key_Left:
        case Qt::Key_Right:
            if (chosen_ != 0) {
                (chosen_ == 'A' ? cursors_.a : cursors_.b) += secondsOfPixel() * (left ? -1 : 1);
            } else {
                range_.pan(span.length() * panShare * (left ? -1 : 1));
            }
            break;
        case Qt::Key_Up:
            range_.zoom(zoomFactor, (span.from + span.to) / 2);
            break;
        case Qt::Key_Down:
            range_.zoom(1 / zoomFactor, (span.from + span.to) / 2);
            break;
        case Qt::Key_Plus:
        case Qt::Key_Minus:
            for (PlotPanel* each : panels_) {
                each->zoomValues(event->key() == Qt::Key_Plus ? zoomFactor : 1 / zoomFactor);
            }
            break;
        case Qt::Key_C:
            return toggleCursors();
        case Qt::Key_A:
        case Qt::Key_B:
            if (!cursors_.shown) toggleCursors();
            chosen_ = event->key() == Qt::Key_A ? 'A' : 'B';
            break;
        case Qt::Key_Escape:
            if (chosen_ == 0) return event->ignore();
            chosen_ = 0;
            break;
        case Qt::Key_Delete:
            return removeLine(legend_->chosen());
        default:
            return QWidget::keyPressEvent(event);
    }
    redraw();
}

// Tab goes through the lines first.
bool PlotView::focusNextPrevChild(bool next) {
    if (hasFocus()) {
        const auto& all = lines_.all();
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].tag != legend_->chosen()) continue;
            const std::size_t other = next ? i + 1 : i - 1;
            if (other >= all.size()) break;
            legend_->choose(all[other].tag);
            frames_ = 0;
            redraw();
            return true;
        }
    }
    return QWidget::focusNextPrevChild(next);
}

void PlotView::contextMenuEvent(QContextMenuEvent* event) {
    const bool byKey = event->reason() == QContextMenuEvent::Keyboard;
    openMenu(byKey ? legend_->chosen() : 0, event->globalPos());
}

void PlotView::openMenu(int tag, const QPoint& at) {
    auto* menu = new QMenu{this};
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const PlotLine* line = lines_.find(tag);
    const auto add = [&](const QString& text, const auto& act) {
        connect(menu->addAction(text), &QAction::triggered, this, act);
    };
    if (line != nullptr) {
        add(tr("Remove %1 %2").arg(tag).arg(line->name()), [this, tag] { removeLine(tag); });
        if (!line->lane) {
            add(tr("To a panel of its own"), [this, tag] { moveLine(tag, lines_.panels(), true); });
            if (line->panel > 0) {
                add(tr("To the panel above"),
                    [this, tag, panel = line->panel - 1] { moveLine(tag, panel); });
            }
        }
        menu->addSeparator();
    }
    if (!history_.empty()) {
        add(tr("Undo: %1  Ctrl+Z").arg(history_.change()), [this] { undo(); });
    }
    add(tr("Fit values"), [this] {
        for (PlotPanel* each : panels_) each->resetValues();
        redraw();
    });
    auto* units = menu->addMenu(tr("Units"));
    fillUnitMenu(*units, [this] {
        return UnitsOfView{[this] { return lines_.units(); },
                           [this](const ShownUnits& chosen) { setUnits(chosen); }};
    });
    add(tr("Export CSV…"), [this] { askForFile(QStringLiteral("csv")); });
    add(tr("Export PNG…"), [this] { askForFile(QStringLiteral("png")); });
    add(tr("Export SVG…"), [this] { askForFile(QStringLiteral("svg")); });
    menu->popup(at);
}

void PlotView::setUnits(const ShownUnits& units) {
    lines_.setUnits(units);
    for (PlotPanel* each : panels_) each->resetValues();
    frames_ = 0;
    redraw();
    Q_EMIT changed();
}

void PlotView::askForFile(const QString& kind) {
    auto* dialog = new QFileDialog{this, tr("Export")};
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(kind);
    dialog->selectFile(QStringLiteral("plot.%1").arg(kind));
    connect(dialog, &QFileDialog::fileSelected, this,
            [this](const QString& file) { exportAndTell(file); });
    dialog->open();
}

void PlotView::exportAndTell(const QString& file) {
    const QString why = exportTo(file);
    if (why.isEmpty())
        written_ = tr("written to %1").arg(file);
    else
        notWritten_ = tr("%1 was not written: %2.").arg(file, why);
    frames_ = 0;
    redraw();
}

QString PlotView::exportTo(const QString& file) {
    const TimeSpan span = range_.shown();
    QStringList names;
    for (const PlotLine& each : lines_.all()) {
        names.append(QStringLiteral("%1 %2").arg(each.tag).arg(each.name()));
    }
    const QString when =
        tr("%1 %2 to %3 %4")
            .arg(dayText(span.from), momentText(span.from), momentText(span.to), zoneText(span.to));
    written_.clear();  // the picture does not tell of the export before
    notWritten_.clear();
    frames_ = 0;
    redraw();
    const PlotReport report{*column_, side_->isHidden() ? nullptr : legend_, when, names};
    QBuffer out;
    out.open(QIODevice::WriteOnly);
    if (file.endsWith(QStringLiteral(".csv"))) {
        std::ostringstream text;
        writeCsv(text, drawn(), recorder_, span);
        out.write(QByteArray::fromStdString(text.str()));
    } else if (file.endsWith(QStringLiteral(".svg"))) {
        QSvgGenerator svg;
        svg.setOutputDevice(&out);
        svg.setTitle(when);
        svg.setDescription(names.join(QStringLiteral(", ")));
        svg.setSize(report.size());
        svg.setViewBox(QRect{{}, report.size()});
        QPainter painter{&svg};
        report.paint(painter);
    } else {
        QImage image{report.size() * 2, QImage::Format_RGB32};
        image.setDevicePixelRatio(2);
        QPainter painter{&image};
        report.paint(painter);
        painter.end();
        if (!image.save(&out, "PNG")) return tr("the picture cannot be made");
    }
    return writeWholeFile(file, out.data());
}

QJsonObject PlotView::saved() const {
    QJsonArray items;
    for (const PlotLine& each : lines_.all()) {
        items.append(
            QJsonObject{{QStringLiteral("item"), QString::fromStdString(textOf(each.item))},
                        {QStringLiteral("panel"), each.known ? each.panel : each.wish}});
    }
    return {{QStringLiteral("items"), items},
            {QStringLiteral("units"), lines_.units().saved()},
            {QStringLiteral("span"), range_.span()},
            {QStringLiteral("statistics"), legend_->showsStatistics()},
            {QStringLiteral("legend"), !side_->isHidden()}};
}

// A change of the user, which can be undone.
void PlotView::change(const QString& words, const std::function<bool(PlotLines&)>& act) {
    PlotLines before = lines_;
    if (!act(lines_)) {
        lines_ = std::move(before);
        return;
    }
    history_.remember(std::move(before), words);
    if (frame_) lines_.learn(*frame_);
    record();
    frames_ = 0;
    redraw();
    Q_EMIT changed();
}

void PlotView::add(const std::vector<RecordedItem>& items, int panel, bool anew) {
    if (items.empty()) return redraw();
    const QString words = items.size() == 1
                              ? tr("add %1").arg(QString::fromStdString(textOf(items.front())))
                              : tr("add %1 lines").arg(items.size());
    change(words, [&](PlotLines& lines) { return put(lines, items, {panel, anew}); });
}

void PlotView::removeLine(int tag) {
    const PlotLine* line = lines_.find(tag);
    if (line == nullptr) return;
    change(tr("remove %1 %2").arg(tag).arg(line->name()),
           [tag](PlotLines& lines) { return lines.remove(tag); });
}

void PlotView::moveLine(int tag, int panel, bool anew) {
    const PlotLine* line = lines_.find(tag);
    if (line == nullptr) return;
    change(tr("move %1 %2").arg(tag).arg(line->name()),
           [&](PlotLines& lines) { return lines.move(tag, panel, anew); });
}

void PlotView::undo() {
    auto before = history_.undo();
    if (!before) return;
    before->setUnits(lines_.units());
    lines_ = std::move(*before);
    if (frame_) lines_.learn(*frame_);
    record();
    frames_ = 0;
    redraw();
    Q_EMIT changed();
}

// The window undoes other things with the same key.
bool PlotView::event(QEvent* event) {
    const bool asks = event->type() == QEvent::ShortcutOverride &&
                      static_cast<QKeyEvent*>(event)->matches(QKeySequence::Undo);
    if (asks) event->accept();
    return asks || QWidget::event(event);
}

void PlotView::restore(const QJsonObject& saved) {
    lines_.setUnits(ShownUnits::restored(saved[QStringLiteral("units")].toArray()));
    for (const QJsonValue each : saved[QStringLiteral("items")].toArray()) {
        const QJsonObject of = each.toObject();
        const auto item = recordedItem(of[QStringLiteral("item")].toString().toStdString());
        if (item) add({*item}, of[QStringLiteral("panel")].toInt(-1));
    }
    history_.clear();
    range_.setSpan(saved[QStringLiteral("span")].toDouble(range_.span()));
    if (saved[QStringLiteral("statistics")].toBool() != legend_->showsStatistics()) {
        toggleStatistics();  // which shows the legend
    }
    side_->setVisible(saved[QStringLiteral("legend")].toBool(true));
}

}  // namespace cortex::gui
