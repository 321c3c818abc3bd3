// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtWidgets/QLabel>

#include <algorithm>

inline QJsonObject objectOf(const char *json)
{
    return QJsonDocument::fromJson(json).object();
}

/// Whether a label that is seen has \a text.
inline bool showsText(const QWidget &panel, const QString &text)
{
    const QList<QLabel *> labels = panel.findChildren<QLabel *>();
    return std::any_of(labels.begin(), labels.end(),
                       [&](const QLabel *label) { return label->isVisibleTo(&panel) && label->text().contains(text); });
}
