#include <set>
#include <stdexcept>

#include "testenv/edit/edits.h"

namespace hipr::test {

const Rows& allRows() {
    static const Rows rows = [] {
        Rows result;
        std::set<std::string> names;
        for (const auto topic : {
                 meshRows,
                 primvarRows,
                 materialRows,
                 textureRows,
                 lightRows,
                 instanceRows,
                 hierarchyRows,
                 timeRows,
                 viewRows,
                 splatRows,
                 shapeRows,
#ifdef HIPR_VDB_KIT
                 volumeRows,
#endif
             })
            for (Row& row : topic()) {
                if (!names.insert(row.name).second) throw std::logic_error("two rows are called " + row.name);
                result.push_back(std::move(row));
            }
        return result;
    }();
    return rows;
}

} // namespace hipr::test
