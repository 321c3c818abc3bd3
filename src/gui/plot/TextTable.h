// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "signals/TableText.h"

#include <QtCore/QByteArray>

#include <memory>

namespace qplc {

/// A table that is written as text, a piece at a time, so that a window goes on meanwhile.
class TextTable
{
public:
    TextTable() = default;
    TextTable(const TextTable &) = default;
    TextTable &operator=(const TextTable &) = default;
    virtual ~TextTable() = default;

    /// The titles of the columns, as a row.
    virtual QByteArray header() const = 0;
    virtual bool isAtEnd() const = 0;
    /// The next rows: one at least, if there is one, and at most so many.
    virtual QByteArray next(int mostRows) = 0;
    virtual std::int64_t rows() const = 0;  // that were given
};

}  // namespace qplc
