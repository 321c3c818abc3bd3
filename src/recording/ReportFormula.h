// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Recording.h"

#include <memory>

namespace qplc {

/// A formula of a plot, "= norm(force)", calculated cycle by cycle as a window does it.
class ReportFormula
{
public:
    /// \param columns  of the rows of next(), for each signal of Recording::signalList(); -1: it
    /// has no column
    ReportFormula(const QString &text, const Recording &recording, const std::vector<int> &columns);
    ReportFormula(ReportFormula &&other) noexcept;
    ~ReportFormula();

    static bool isFormula(const QString &text);
    const QString &text() const { return m_text; }
    /// Why it cannot be calculated, for people; empty: it can.
    const QString &problem() const { return m_problem; }
    /// Of the result; empty: it is not known.
    const QString &unit() const { return m_unit; }
    /// The result of the next cycle, and how far it can be trusted: as far as the worst of its
    /// signals. \pre there is no problem
    overview::Bucket next(const RecordedRows &rows);

private:
    struct Private;

    QString m_text;
    QString m_problem;
    QString m_unit;
    std::unique_ptr<Private> d;  // null: there is a problem
};

}  // namespace qplc
