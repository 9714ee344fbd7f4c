// Columns to a file of parquet.
import { parquetWriteBuffer } from "hyparquet-writer";

window.parquet = (columnData) => parquetWriteBuffer({ columnData });
