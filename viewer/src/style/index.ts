// The page's looks; the order counts, what is narrower comes last.

import "uplot/dist/uPlot.min.css";
import "./base.css";
import "./head.css";
import "./picture.css";
import "./panels.css";
import "./live.css";
import "./phone.css";
