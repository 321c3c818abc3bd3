// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmuDescription.h"

namespace qplc {

/// A number of an FMU: an element of a variable, or a variable that is none.
struct FmuElement
{
    const FmuVariable *variable = nullptr;
    int element = 0;  // of all its elements, row after row
};

/// Finds what a name stands for: a variable; an array whose elements are variables ("r" for "r[1]",
/// "r[2]", "r[3]", as FMI 2.0 has them); an element of an array, from 0.
class FmuWiring
{
public:
    /// \param description  outlives the object
    explicit FmuWiring(const FmuDescription &description);

    /// The numbers that \a name stands for, in their order.
    /// \return none, with the reason and the remedy in \a error
    QVector<FmuElement> find(const QString &name, QString *error) const;
    /// Names that stand for all numbers of the FMU, arrays in the place of their elements.
    QStringList names() const;

private:
    struct Member
    {
        QVector<int> index;  // "[2,3]"
        const FmuVariable *variable = nullptr;
    };

    const FmuDescription &m_description;
    QHash<QString, QVector<Member>> m_arrays;  // sorted by their index
};

}  // namespace qplc
