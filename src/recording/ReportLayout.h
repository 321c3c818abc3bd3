// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <vector>

namespace qplc {

/// A time plot of a layout of the Control Center, as a report can draw it.
struct ReportPanel
{
    struct Curve
    {
        QString signal;  // "power", "position[2]", "= norm(position)"
        QString name;    // for people; empty: that of the signal
        double gain = 1.0;
        double offset = 0.0;
        bool isBands = false;  // states, as a strip
    };

    QString title;
    std::vector<Curve> curves;  // those that are seen
};

/// The time plots of the tabs and windows of a layout file, in its order.
/// \return false, with a sentence, when it is not a layout or has no time plot
bool readLayoutPlots(const QByteArray &json, std::vector<ReportPanel> *panels, QString *error);

}  // namespace qplc
