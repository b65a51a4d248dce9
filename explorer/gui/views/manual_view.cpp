// SPDX-License-Identifier: Apache-2.0
#include "views/manual_view.hpp"

#include "manual_text.hpp"
#include "style/look.hpp"

#include <QAbstractTextDocumentLayout>
#include <QScrollBar>
#include <QTextBlock>
#include <QVariant>

namespace cortex::gui {

namespace {

constexpr const char* sectionProperty = "cortexManual";

// Its pictures show the window that one looks at.
QString pageWithoutPictures() {
    QStringList lines;
    for (const QString& line : QString::fromUtf8(manualText).split('\n')) {
        if (!line.startsWith(QLatin1String{"!["})) lines << line;
    }
    return lines.join('\n');
}

bool isSection(const QTextBlock& block) { return block.blockFormat().headingLevel() > 0; }

}  // namespace

ManualView::ManualView(QWidget* parent) : QTextBrowser{parent} {
    setOpenLinks(false);  // its links lead to other pages, which are not built in
    setFrameShape(QFrame::NoFrame);
    setAccessibleName(tr("Manual"));
    restyle();
}

void ManualView::restyle() {
    setFont(Look::font(TextSize::Text));
    document()->setDefaultFont(font());
    document()->setDocumentMargin(Look::units(4));
    setMarkdown(pageWithoutPictures());
    openAt(section_);
}

QStringList ManualView::sections() const {
    QStringList names;
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
        if (isSection(block)) names << block.text();
    }
    return names;
}

bool ManualView::openAt(const QString& section) {
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
        if (!isSection(block) || block.text() != section) continue;
        section_ = section;
        setTextCursor(QTextCursor{block});
        const QRectF place = document()->documentLayout()->blockBoundingRect(block);
        verticalScrollBar()->setValue(static_cast<int>(place.top()));
        return true;
    }
    return false;
}

QString ManualView::section() const { return section_; }

void ManualView::helpOf(QWidget& widget, const QString& section) {
    widget.setProperty(sectionProperty, section);
}

QString ManualView::sectionOf(const QWidget* widget) {
    for (; widget != nullptr; widget = widget->parentWidget()) {
        const QVariant section = widget->property(sectionProperty);
        if (section.isValid()) return section.toString();
    }
    return {};
}

}  // namespace cortex::gui
