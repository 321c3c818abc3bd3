// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Recording.h"
#include "ReportLayout.h"

namespace qplc {

/// What a report shows of a recording.
struct ReportSelection
{
    RecordedTime begin = 0;
    RecordedTime end = 0;
    /// Of Recording::signalList(): each has a plot. Empty: the first ones that change.
    std::vector<int> signalNumbers;
    /// Sections of others behind the figures: headings `#`, tables `| a | b |`, lists `- a`, and
    /// paragraphs, as in Markdown.
    QStringList sections;
    /// Plots in place of those of signalNumbers, with their formulas, which begin with `begin`.
    std::vector<ReportPanel> panels;
    struct Picture
    {
        QString title;
        QByteArray bytes;  // PNG, JPEG or SVG
    };
    std::vector<Picture> pictures;  // before the plots
};

/// The kind of a picture by its first bytes: "image/png", "image/jpeg", "image/svg+xml"; empty: it
/// is none of these.
QByteArray mediaTypeOf(const QByteArray &picture);

/// A page of HTML that contains all it needs: figures, plots, what has happened, jitter, nodes and
/// signals. It is light or dark as its reader wants it, and light on paper.
/// \param damages  of the recording: chunks that were left out
QByteArray reportOf(Recording &recording, const ReportSelection &selection, int *damages);

/// A page of HTML in the style of a report. \param name  of what it is about \param body  what
/// follows its title, as HTML
QByteArray pageOf(const QString &name, const QString &subtitle, const QByteArray &body);

/// A part of Markdown as HTML: see ReportSelection::sections.
QByteArray htmlOfMarkdown(const QString &text);

}  // namespace qplc
