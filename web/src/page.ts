// The script of the report page.

import { enlivenReport } from "./report";

enlivenReport(document);
